// SPDX-License-Identifier: MIT
// Reading a CSV file: bytes per second of processor time. Names are part/whose/rows.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "libtrack/read/read.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

// A file of `rows` rows, about 43 bytes each, that is removed afterwards.
class Csv {
 public:
  explicit Csv(std::int64_t rows) : path_(std::filesystem::temp_directory_path() / fmt::format("swarmfit_read_bench_{}.csv", rows)) {
    std::ofstream out(path_);
    out << "id,frame,x,y,z\n";
    for (std::int64_t k = 0; k < rows; ++k) {
      const auto xy = Rng{1}.uniform2(Stream::start, static_cast<std::uint64_t>(k), 0);
      out << fmt::format("{},{},{:.6f},{:.6f},{:.6f}\n", k % 100, k / 100, 1000 * xy[0], 1000 * xy[1], 500 * (xy[0] + xy[1]));
    }
  }
  Csv(const Csv&) = delete;
  Csv& operator=(const Csv&) = delete;
  ~Csv() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(std::filesystem::file_size(path_)); }

 private:
  std::filesystem::path path_;
};

void ours(benchmark::State& state) {
  const Csv csv(state.range(0));
  ReadOptions options;
  options.fps = 100;
  options.unit = "mm";
  for (auto _ : state) benchmark::DoNotOptimize(read_tracks(csv.path(), options).rows());
  state.SetBytesProcessed(state.iterations() * csv.bytes());
}
BENCHMARK(ours)->Name("csv/ours")->Arg(100000)->Arg(2000000)->Unit(benchmark::kMillisecond);

// What reading and converting must cost: no columns, no checks, no tracks.
void limit(benchmark::State& state) {
  const Csv csv(state.range(0));
  for (auto _ : state) {
    std::ifstream in(csv.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    double sum = 0;
    for (const char *at = text.data() + text.find('\n') + 1, *end = text.data() + text.size(); at < end; ++at) {
      double value = 0;
      at = std::from_chars(at, end, value).ptr;
      sum += value;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetBytesProcessed(state.iterations() * csv.bytes());
}
BENCHMARK(limit)->Name("csv/std::from_chars alone")->Arg(100000)->Arg(2000000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmfit
