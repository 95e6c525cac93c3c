// SPDX-License-Identifier: MIT
// fuzz_readers --target=NAME CORPUS...   libFuzzer on one target; its own flags begin with one dash.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/fuzz.h"

namespace {

const swarmfit::fuzz::Target* g_target = nullptr;  // libFuzzer's entry has no other way to know it

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static const auto all = swarmfit::fuzz::targets();
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (word == "--list") {
      for (const auto& target : all) std::puts(target.name.c_str());
      std::exit(0);
    }
    if (!word.starts_with("--target=")) continue;
    try {
      g_target = &swarmfit::fuzz::find(all, word.substr(9));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      std::exit(2);
    }
  }
  if (!g_target) {
    std::fprintf(stderr, "which target? expected --target=NAME; --list names them\n");
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  g_target->take({reinterpret_cast<const char*>(data), size});
  return 0;
}
