// SPDX-License-Identifier: MIT
// smoke_readers SEEDS MUTATIONS   every seed of every target, each changed so many times: a short walk without libFuzzer, for every build.
// SEEDS is what make_seeds.py has made. Targets that start a process for every input get a hundredth. Exit code 1 when a target has no
// seed; a broken one ends the program where it is, and leaves the input in ./crash.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/fuzz.h"

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Draws of one mutation.
class Draws {
 public:
  explicit Draws(std::uint64_t number) : state_(number * 0x9E3779B97F4A7C15u + 1) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : next() % n; }

 private:
  std::uint64_t next() {  // SplitMix64
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

// What breaks readers: ends, signs, exponents, quotes, huge and odd numbers.
constexpr const char* kPieces[] = {"\n",  "\r",   ",",    ";",   "\t",    "\"",   "#",  "-",          "e308",        "nan",
                                   "inf", "1e19", "-1e9", "\\n", "\0x00", "\xFF", "[[", "2147483648", "99999999999", "="};

void change(std::string& bytes, Draws& draw) {
  const std::size_t at = draw.below(bytes.size() + 1), length = 1 + draw.below(16);
  switch (draw.below(7)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << draw.below(8)));
      return;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(draw.below(256));
      return;
    case 2:
      bytes.erase(at, length);
      return;
    case 3:
      bytes.insert(at, bytes.substr(draw.below(bytes.size() + 1), length));
      return;
    case 4:
      bytes.insert(at, kPieces[draw.below(std::size(kPieces))]);
      return;
    case 5:
      bytes.resize(at);
      return;
    default:
      for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) bytes[i] = draw.below(2) == 0 ? '\0' : '\xFF';
  }
}

// Leaves the input in ./crash when it is the last one. The file is overwritten in place: one made anew every time waits for the disk.
void take(const swarmfit::fuzz::Target& target, const std::string& bytes) {
  static std::ofstream crash("crash", std::ios::binary);
  crash.seekp(0);
  crash.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  fs::resize_file("crash", bytes.size());
  target.take(bytes);
}

std::size_t walk(const swarmfit::fuzz::Target& target, const fs::path& folder, std::size_t mutations) {
  std::size_t seeds = 0;
  std::error_code none;
  for (const auto& file : fs::directory_iterator(folder / target.name, none)) {
    const std::string seed = content(file.path());
    take(target, seed);
    for (std::size_t k = 0; k < mutations; ++k) {
      std::string bytes = seed;
      Draws draw(k);
      for (std::size_t n = 1 + draw.below(4); n > 0; --n) change(bytes, draw);
      take(target, bytes);
    }
    ++seeds;
  }
  return seeds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "%s SEEDS MUTATIONS\n", argv[0]);
    return 2;
  }
  const std::size_t mutations = std::strtoul(argv[2], nullptr, 10);
  bool complete = true;
  for (const auto& target : swarmfit::fuzz::targets()) {
    const std::size_t seeds = walk(target, argv[1], target.slow ? mutations / 100 : mutations);
    std::printf("%-20s %zu seeds\n", target.name.c_str(), seeds);
    complete = complete && seeds > 0;
  }
  fs::remove("crash");
  return complete ? 0 : 1;
}
