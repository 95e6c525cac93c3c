// SPDX-License-Identifier: MIT
#include "fit/experiment/journal.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fit/compare/compare.h"
#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const RunIdentity kRun{"1.2.3", "abcdef", "[compare]\nseed = 1\n"};
constexpr int kDamages = 1000;

void expect_same(const Outcome& a, const Outcome& b) {
  const auto bits = [](const Energies& e) { return std::string(reinterpret_cast<const char*>(e.data()), e.size() * sizeof(double)); };
  EXPECT_EQ(bits(a.raw), bits(b.raw));
  EXPECT_EQ(bits(a.guided), bits(b.guided));
  ASSERT_EQ(a.replicates.size(), b.replicates.size());
  for (std::size_t r = 0; r < a.replicates.size(); ++r) EXPECT_EQ(bits(a.replicates[r]), bits(b.replicates[r]));
  EXPECT_EQ(a.failed, b.failed);
  EXPECT_EQ(a.differences, b.differences);
  EXPECT_EQ(a.count.agent_steps, b.count.agent_steps);
}

Outcome outcome(int k) {
  Outcome o;
  o.raw = o.guided = Energies(7);
  for (std::size_t j = 0; j < 7; ++j) o.raw[j] = k + 0.1 * static_cast<double>(j), o.guided[j] = j == 3 ? NAN : -o.raw[j];
  o.replicates.assign(static_cast<std::size_t>(1 + k % 3), o.raw);
  o.failed = k % 2;
  o.count.agent_steps = 1000 + k;
  return o;
}

class JournalTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }

  // Ten outcomes in three additions.
  void fill() const {
    Checkpoint checkpoint(path(), kRun, [] {});
    Journal journal(checkpoint);
    for (const auto& [from, to] : {std::pair{0, 4}, {4, 5}, {5, 10}}) {
      std::vector<std::pair<std::string, Outcome>> batch;
      for (int k = from; k < to; ++k) batch.emplace_back(key(k), outcome(k));
      journal.add(batch);
    }
  }
  static std::string key(int k) { return Journal::key("model", std::vector<double>{1.0, k + 0.5}, std::vector<Rng>{{7}, {8}}); }
  std::string path() const { return (dir_ / "checkpoint").string(); }
  void write(const std::string& bytes) const { std::ofstream(path(), std::ios::binary) << bytes; }

  fs::path dir_ = fs::temp_directory_path() / ("swarmfit_journal_" + std::to_string(::getpid()));
};

TEST_F(JournalTest, KeepsEveryOutcomeToTheBit) {
  fill();
  Checkpoint checkpoint(path(), kRun);
  EXPECT_EQ(checkpoint.size(), 10u);
  const Journal journal(checkpoint);
  for (int k = 0; k < 10; ++k) {
    const auto found = journal.find(key(k));
    ASSERT_TRUE(found);
    expect_same(*found, outcome(k));
  }
  EXPECT_FALSE(journal.find(key(10)));
}

TEST_F(JournalTest, KeysTellEnsemblesParametersAndSeedsApart) {
  const std::vector<double> p{1, 2}, q{1, 2.0000000000000004};
  const std::vector<Rng> one{{7}}, two{{7}, {8}};
  const auto first = Journal::key("a", p, one);
  EXPECT_EQ(first, Journal::key("a", p, one));
  for (const auto& other : {Journal::key("b", p, one), Journal::key("a", q, one), Journal::key("a", p, two)}) EXPECT_NE(first, other);
}

TEST_F(JournalTest, TouchesNothingBeforeTheFirstOutcome) {
  int prepared = 0;
  Checkpoint checkpoint(path(), kRun, [&] { ++prepared; });
  Journal journal(checkpoint);
  journal.add({});
  EXPECT_EQ(prepared, 0);
  EXPECT_FALSE(fs::exists(path()));
  const std::vector<std::pair<std::string, Outcome>> batch{{key(1), outcome(1)}};
  journal.add(batch);
  journal.add(batch);
  EXPECT_EQ(prepared, 1);
}

// Cut or flipped anywhere: what is found is as it was written, or not found, or the file is refused. Whatever is added afterwards is found.
TEST_F(JournalTest, DamageNeverYieldsAnotherOutcome) {
  fill();
  const std::string whole = read_file(path());
  const Rng rng{3};
  int refused = 0, fewer = 0;
  for (int d = 0; d < kDamages; ++d) {
    const auto bits = rng.bits(Stream::probe, static_cast<std::uint64_t>(d), 0);
    std::string bytes = whole;
    const std::size_t at = bits[0] % whole.size();
    if (d % 2) {
      bytes.resize(at);
    } else {
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bits[1] % 8));
    }
    write(bytes);
    try {
      Checkpoint checkpoint(path(), kRun);
      fewer += checkpoint.size() < 10;
      Journal journal(checkpoint);
      for (int k = 0; k < 10; ++k)
        if (const auto found = journal.find(key(k))) expect_same(*found, outcome(k));
      const std::vector<std::pair<std::string, Outcome>> more{{key(99), outcome(99)}};
      journal.add(more);
    } catch (const InputError&) {
      ++refused;
      continue;
    }
    Checkpoint reopened(path(), kRun);
    const Journal again(reopened);
    ASSERT_TRUE(again.find(key(99))) << "damage " << d << " at " << at;
    expect_same(*again.find(key(99)), outcome(99));
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(refused + fewer, kDamages);  // no damage goes unnoticed
}

TEST_F(JournalTest, RefusesAnotherRun) {
  fill();
  const auto open = [&](const RunIdentity& run) { return [this, run] { const Checkpoint checkpoint(path(), run); }; };
  EXPECT_THAT(open({"1.2.4", kRun.recording, kRun.config}), ThrowsMessage<InputError>(HasSubstr("another version 1.2.3")));
  EXPECT_THAT(open({kRun.version, "fedcba", kRun.config}), ThrowsMessage<InputError>(HasSubstr("another recording")));
  EXPECT_THAT(open({kRun.version, kRun.recording, "x"}), ThrowsMessage<InputError>(HasSubstr("other settings")));
  write("id,x,y\n");
  EXPECT_THAT(open(kRun), ThrowsMessage<InputError>(HasSubstr("is not a checkpoint")));
  fs::remove(path());
  EXPECT_THAT(open(kRun), ThrowsMessage<InputError>(HasSubstr("no such file")));
}

// The whole path: a comparison stopped at any byte of its checkpoint goes on to the same result, and simulates only what is missing.
TEST_F(JournalTest, AComparisonGoesOnToTheSameResult) {
  const Tracks recording = test::planted_swarm(1);
  CompareOptions options;
  options.models = {parse_model("brownian"), parse_model("langevin")};
  options.binning = Binning::standard(Normalisation::reference);
  options.budget = {"tiny", {8, 3, 2}, {4, 2, 3}, 4, 3, 2};
  options.bootstrap_recordings = 9;
  const Comparison plain = compare(recording, options);
  const auto scores = [](const Comparison& c) {
    std::vector<double> out;
    for (const auto& m : c.models)
      out.push_back(m.standing.score), out.push_back(m.standing.in_sample.score_se), out.push_back(m.likeness.skill.value);
    for (const auto& row : c.run.history) out.insert(out.end(), row.raw.begin(), row.raw.end());
    return out;
  };
  {
    Checkpoint checkpoint(path(), kRun, [] {});
    EXPECT_EQ(scores(compare(recording, options, {}, {&threads(), &checkpoint})), scores(plain));
  }
  const std::string whole = read_file(path());
  const std::size_t distinct = Checkpoint(path(), kRun).size();
  for (const std::size_t share : {100, 73, 40, 11, 3}) {
    write(whole.substr(0, whole.size() * share / 100));
    Checkpoint checkpoint(path(), kRun);
    EXPECT_EQ(scores(compare(recording, options, {}, {&threads(), &checkpoint})), scores(plain)) << share;
    EXPECT_EQ(Checkpoint(path(), kRun).size(), distinct) << share;
    if (share == 100) {
      EXPECT_EQ(read_file(path()), whole) << "what was known has been simulated again";
    }
  }
}

}  // namespace
}  // namespace swarmfit
