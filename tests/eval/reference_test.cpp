// SPDX-License-Identifier: MIT
// The whole way from positions to energies against tests/reference/evaluate.py, an implementation of its own in another language.
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "libeval/energy.h"
#include "libeval/score.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Row;
using test::tracks_of;

constexpr std::array kModes = {Normalisation::reference, Normalisation::separate, Normalisation::none};
constexpr std::array kModeNames = {"reference", "separate", "none"};

// ---- recordings ----------------------------------------------------------------------------------------------------------------

// Random accelerations in a trap, with holes in the tracks. Only sums, products and integer-made uniforms, so that the bits are the same
// everywhere and stored numbers stay valid.
std::vector<Row> swarm(std::uint64_t seed, double push) {
  constexpr double dt = 0.01;
  std::vector<Row> rows;
  std::array<std::array<double, 6>, 12> state{};
  for (std::int64_t k = 0; k < 120; ++k)
    for (std::uint32_t i = 0; i < state.size(); ++i) {
      auto& s = state[i];
      const auto tick = static_cast<std::uint64_t>(k) + 1;
      for (std::uint32_t a = 0; a < 3; ++a) {
        if (k == 0) s[a] = 100 * (test::uniform(seed, 0, i, a) - 0.5);
        s[a + 3] += dt * (-20 * s[a]) + push * (test::uniform(seed, tick, i, a) - 0.5);
        s[a] += dt * s[a + 3];
      }
      if (test::uniform(seed, tick, i, 9) < 0.97) rows.push_back({i, k, {s[0], s[1], s[2]}});
    }
  return rows;
}

Tracks hundred_hertz(const std::vector<Row>& rows) { return tracks_of(rows, {.dt = 0.01}); }

// ---- evaluate.py ---------------------------------------------------------------------------------------------------------------

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return out;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) out.append(buffer.data(), n);
  return pclose(pipe) == 0 ? out : std::string();
}

class Reference : public testing::Test {
 protected:
  void SetUp() override {
    if (output_of("command -v python3").empty()) GTEST_SKIP() << "NOT COMPARED with evaluate.py: there is no python3 on this machine";
    std::string name = (fs::temp_directory_path() / "swarmfit-reference-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  fs::path write(const std::string& name, const Tracks& tracks) {
    std::ostringstream out;
    out.precision(17);
    out << "id,frame,t,x,y,z\n";
    for (Index row = 0; row < tracks.rows(); ++row) {
      const auto k = static_cast<std::size_t>(row);
      out << tracks.names()[tracks.track()[k]] << ',' << tracks.frame()[k] << ',' << tracks.time(tracks.frame()[k]);
      for (Index axis = 0; axis < 3; ++axis) out << ',' << tracks.pos()(row, axis);
      out << '\n';
    }
    return write(name, out.str());
  }

  json python(const std::string& arguments) {
    const std::string text = output_of("python3 '" SWARMFIT_SOURCE_DIR "/tests/reference/evaluate.py' " + arguments + " --json");
    EXPECT_FALSE(text.empty()) << "evaluate.py failed on " << arguments;
    return text.empty() ? json() : json::parse(text);
  }

  void compare(const Tracks& real, const Tracks& sim) {
    const std::string files = "'" + write("real.csv", real).string() + "' '" + write("sim.csv", sim).string() + "'";
    for (std::size_t mode = 0; mode < kModes.size(); ++mode) {
      SCOPED_TRACE(kModeNames[mode]);
      const json want = python(files + " --dt 0.01 --normalisation " + kModeNames[mode]);
      ASSERT_FALSE(want.is_null());
      const Target target(metric_samples(real), Binning::standard(kModes[mode]));
      const auto simulated = target.distributions(metric_samples(sim));
      const Energies energies = target.energies(simulated);
      EXPECT_EQ(want["bins"], target.binning().bins);
      EXPECT_EQ(want["interval"], json::array({target.binning().lower, target.binning().upper}));
      for (std::size_t m = 0; m < kMetrics; ++m) {
        SCOPED_TRACE(kMetricInfo[m].key);
        const std::string key(kMetricInfo[m].key);
        EXPECT_NEAR(energies[m], want["raw_energies"][key].get<double>(), 1e-10);
        expect_same(target.recording()[m], want, "real", key);
        expect_same(simulated[m], want, "sim", key);
      }
    }
  }

 private:
  static void expect_same(const Distribution& d, const json& want, const char* set, const std::string& key) {
    EXPECT_EQ(d.moments.count, want["samples"][set][key]);
    EXPECT_EQ(d.histogram.samples, want["samples"][set][key]);
    EXPECT_EQ(d.histogram.outside, want["outside"][set][key]);
    const double mean = want["mean"][set][key], sd = want["sd"][set][key];
    EXPECT_NEAR(d.moments.mean, mean, 1e-10 * (std::abs(mean) + sd));
    EXPECT_NEAR(d.moments.sd(), sd, 1e-10 * sd);
  }

  fs::path folder_;
};

TEST_F(Reference, EnergiesOfSyntheticRecordings) { compare(hundred_hertz(swarm(1, 20)), hundred_hertz(swarm(2, 30))); }

TEST_F(Reference, EnergiesOfARealRecording) {
  const fs::path file = SWARMFIT_SOURCE_DIR "/../shared/data/midge-lab-3d/BiologicalSwarmTimeSeries.txt";
  if (!fs::exists(file)) GTEST_SKIP() << "NOT COMPARED on the midge recording: there is no " << file;
  std::vector<Row> real;
  std::map<std::string, std::uint32_t> numbers;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {  // id,x,y,z,t,...
    std::istringstream fields(line);
    std::string id, field;
    std::getline(fields, id, ',');
    std::array<double, 4> value;
    for (double& v : value) std::getline(fields, field, ','), v = std::stod(field);
    real.push_back({numbers.try_emplace(id, numbers.size()).first->second, std::llround(value[3] * 100), {value[0], value[1], value[2]}});
  }
  ASSERT_GT(real.size(), 5000u);
  auto sim = real;  // stands for a simulation: moved in time, stretched and shaken
  for (Row& row : sim) {
    row.frame += 7 * row.track;
    for (std::uint32_t a = 0; a < 3; ++a)
      row.p[a] = 1.2 * row.p[a] + 0.2 * (test::uniform(3, static_cast<std::uint64_t>(row.frame), row.track, a) - 0.5);
  }
  compare(hundred_hertz(real), hundred_hertz(sim));
}

TEST_F(Reference, EntropyWeights) {
  Eigen::MatrixXd x(5, 7);
  std::ostringstream csv;
  csv << "model,v,a,omega,alpha,mu,d,eta\n";
  for (Index i = 0; i < 5; ++i) {
    csv << 'm' << i;
    for (Index j = 0; j < 7; ++j) {
      x(i, j) = j == 3 ? 0.5 : static_cast<double>((i * 37 + j * 11 + i * i * j * 5) % 64) / 4;
      csv << ',';
      if (i != 2 || j != 5) csv << x(i, j);
    }
    csv << '\n';
  }
  x(2, 5) = std::nan("");
  const json want = python("weigh '" + write("table.csv", csv.str()).string() + "'");
  ASSERT_FALSE(want.is_null());
  const Weighting got = entropy_weights(x);
  for (std::size_t j = 0; j < kMetrics; ++j)
    EXPECT_NEAR(got.weights[j], want["weights"][std::string(kMetricInfo[j].key)].get<double>(), 1e-12) << j;
  for (Index i = 0; i < 5; ++i)
    EXPECT_NEAR(score(x.row(i).transpose(), got), want["models"][static_cast<std::size_t>(i)]["score"].get<double>(), 1e-12) << i;
}

// ---- numbers of evaluate.py, kept for machines without python3 -----------------------------------------------------------------

struct Golden {
  Normalisation mode;
  PerColumn<double> energies;
};
const std::array<Golden, 3> kGolden = {
    {{Normalisation::reference,
      {2.805179888042, 7.253425255766, 4.942173880132, 3.679220345239, 8.493745604716, 4.122799931925, 2.154203953106}},
     {Normalisation::separate,
      {2.63497517576, 2.722270421978, 3.751774495019, 2.371240006185, 2.145521922803, 3.489718833269, 3.682703793359}},
     {Normalisation::none,
      {3.496832319317, 7.509988994928, 5.044328894427, 3.913423508347, 8.542972782907, 4.592144401178, 2.555858420427}}}};
const PerColumn<std::uint64_t> kGoldenSamples = {1359, 1315, 1315, 1272, 1272, 1405, 1321};

// Energies and sample counts of swarm(1, 20) and swarm(2, 30). Change a number only while Reference.EnergiesOfSyntheticRecordings passes.
TEST(Golden, EnergiesOfSyntheticRecordings) {
  const MetricSamples real = metric_samples(hundred_hertz(swarm(1, 20))), sim = metric_samples(hundred_hertz(swarm(2, 30)));
  for (const Golden& golden : kGolden) {
    const Target target(real, Binning::standard(golden.mode));
    const Energies energies = target.energies(target.distributions(sim));
    for (std::size_t m = 0; m < kMetrics; ++m) {
      EXPECT_NEAR(energies[m], golden.energies[m], 1e-10) << kMetricInfo[m].key;
      EXPECT_EQ(target.recording()[m].histogram.samples, kGoldenSamples[m]) << kMetricInfo[m].key;
    }
  }
}

}  // namespace
}  // namespace swarmfit
