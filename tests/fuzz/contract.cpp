// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "libtrack/error.h"
#include "tests/fuzz/fuzz.h"

namespace swarmfit::fuzz {

void broken(const std::string& why) {
  std::fprintf(stderr, "fuzz: %s\n", why.c_str());
  std::abort();
}

const Target& find(const std::vector<Target>& all, std::string_view name) {
  std::string names;
  for (const Target& target : all) {
    if (target.name == name) return target;
    names += ' ' + target.name;
  }
  throw std::runtime_error("no target '" + std::string(name) + "'; expected one of" + names);
}

void contract(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    if (text.find("expected") == std::string_view::npos) broken("does not say what was expected: " + std::string(text));
    if (text.size() > 4000) broken("an endless line: " + std::string(text.substr(0, 200)));
  } catch (const RunError&) {
  } catch (const std::exception& error) {
    broken(std::string("neither InputError nor RunError: ") + error.what());
  }
}

}  // namespace swarmfit::fuzz
