// SPDX-License-Identifier: MIT
// Pickles written by hand, opcode by opcode: what is read, and that nothing else is.
#include <gmock/gmock.h>

#include "tests/track/build.h"
#include "tests/track/packed_make.h"

namespace swarmfit {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::string four(std::size_t n) {
  std::string out;
  for (int k = 0; k < 4; ++k) out += static_cast<char>(n >> (8 * k));
  return out;
}
std::string text(const std::string& s) { return 'X' + four(s.size()) + s; }
std::string bytes(const std::string& s) { return 'B' + four(s.size()) + s; }
std::string small(int n) { return "K"s + static_cast<char>(n); }

std::string type(const std::string& name, const std::string& order) {
  return "cnumpy\ndtype\n" + text(name) + "K\0K\1\x87R(K\3"s + text(order) + "NNNJ\xff\xff\xff\xffJ\xff\xff\xff\xffK\0tb"s;
}

std::string array(const std::vector<int>& dims, const std::string& of, const std::string& data, bool fortran = false) {
  std::string out = "cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\0\x85"s + bytes("b") + "\x87R(K\1("s;
  for (const int d : dims) out += small(d);
  return out + 't' + of + (fortran ? "\x88" : "\x89") + data + "tb";
}

std::string doubles(const std::vector<double>& values) {
  return bytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
}

std::string dict(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string out = "}(";
  for (const auto& [key, value] : entries) out += text(key) + value;
  return out + "u";
}

std::string pickle(const std::string& body) { return "\x80\x03" + body + "."; }

// As numpy.save writes an object.
std::string saved(const std::string& body) { return npy({}, "|O", pickle(array({}, type("O8", "|"), "]" + body + "a"))); }

const std::string kPositions = array({3, 2, 2}, type("f8", "<"), doubles({0, 1, 10, 11, 2, 3, NAN, NAN, 4, 5, 14, 15}));

TEST(Pickle, TrajectoriesOfIdTracker) {
  const std::string file = saved(dict({{"trajectories", kPositions},
                                       {"git_commit", "N"},
                                       {"frames_per_second", small(25)},
                                       {"setup_points", dict({})},
                                       {"identities_labels", "](" + text("one") + text("two") + "e"},
                                       {"id_probabilities", array({3, 2, 1}, type("f8", "<"), doubles({1, 1, 1, 1, .2, 1}))}}));
  const auto tracks = read(file);
  EXPECT_EQ(tracks.meta().from.format, "idtracker-npy");
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_EQ(tracks.dt(), 0.04);
  EXPECT_THAT(tracks.names(), ElementsAre("one", "two"));
  ASSERT_EQ(tracks.rows(), 5);
  EXPECT_EQ(tracks.pos()(4, 1), 15);
  EXPECT_EQ(read(file, {.min_confidence = 0.5}).rows(), 4) << "one of frame 2 is not sure";
  EXPECT_THAT(error_of(saved(dict({{"trajectories", kPositions}}))), HasSubstr("the frame rate is not in the file"));
}

// Protocol 2 writes bytes as a text of as many characters; NumPy writes its own numbers with their types.
TEST(Pickle, OlderProtocolsAndScalars) {
  const std::string latin = "c_codecs\nencode\n" + text("\0\x01\xc2\x80\xc3\xbf"s) + text("latin1") + "\x86R";
  const std::string fps = "cnumpy.core.multiarray\nscalar\n" + type("f8", "<") + "C\x08"s + "\0\0\0\0\0\0\x49\x40"s + "\x86R";
  const auto tracks = read(saved(dict({{"trajectories", array({1, 2, 2}, type("u1", "|"), latin)}, {"frames_per_second", fps}})));
  EXPECT_EQ(tracks.dt(), 1.0 / 50);
  EXPECT_EQ(tracks.pos()(0, 1), 1);
  EXPECT_EQ(tracks.pos()(1, 0), 128);
  EXPECT_EQ(tracks.pos()(1, 1), 255);
}

// Protocol 4: names on the stack, short texts, a memo without numbers.
TEST(Pickle, ArraysByThemselves) {
  const std::string name = "\x8c\x15numpy.core.multiarray\x94\x8c\x0c_reconstruct\x94\x93\x94"s;
  std::string body = array({1, 4}, type("i2", ">"), bytes("\0\x07\0\0\0\x02\1\0"s));
  body.replace(0, body.find("cnumpy\n"), name);
  const auto tracks = read("\x80\x04\x95\0\0\0\0\0\0\0\0"s + body + ".", flags("id,frame,x,y"));
  EXPECT_EQ(tracks.meta().from.format, "pickle");
  EXPECT_THAT(tracks.names(), ElementsAre("7"));
  EXPECT_EQ(tracks.pos()(0, 1), 256);

  const std::string turned = array({2, 1, 2}, type("f8", "<"), doubles({1, 2, 3, 4}), true);
  EXPECT_EQ(read(pickle(turned), flags("frame,id,x,y")).pos()(0, 1), 3);
  const auto column = [](double a, double b) { return array({2}, type("f8", "<"), doubles({a, b})); };
  const std::string columns =
      dict({{"id", column(1, 1)}, {"frame", column(0, 1)}, {"x", column(5, 6)}, {"y", column(7, 8)}, {"note", "N"}});
  EXPECT_EQ(read(pickle(columns), flags()).pos()(1, 1), 8);
  const std::string buffer =
      "cnumpy.core.numeric\n_frombuffer\n(" + doubles({1, 0, 5, 7}) + type("f8", "<") + "K\1K\4\x86"s + text("C") + "tR";
  EXPECT_EQ(read(pickle(buffer), flags("id,frame,x,y")).pos()(0, 1), 7);
}

std::string refusal(const std::string& body) { return error_of(pickle(body), flags("id,frame,x,y"), "f.npy"); }

TEST(Pickle, NothingElseIsMade) {
  EXPECT_THAT(refusal("cos\nsystem\n" + text("true") + "\x85R"),
              HasSubstr("f.npy: is a Python pickle with a system of os; expected numbers"));
  EXPECT_THAT(refusal(text("os") + text("system") + "\x93"), HasSubstr("with a system of os; expected"));
  EXPECT_THAT(refusal("cbuiltins\neval\n"), HasSubstr("with a eval of builtins"));
  EXPECT_THAT(refusal("(ios\nsystem\n"), HasSubstr("with the opcode 0x69; expected"));
  EXPECT_THAT(refusal("cnumpy\nndarray\nK\0\x85R"s), HasSubstr("whose arrays are made in no way of NumPy's"));
  EXPECT_THAT(refusal("K\1K\2\x85R"s), HasSubstr("calls what cannot be called"));
  EXPECT_THAT(refusal("K\1}b"s), HasSubstr("gives a state to a plain value"));
  EXPECT_THAT(refusal("K\1K\2"s), HasSubstr("leaves more than one value"));
  EXPECT_THAT(refusal("h\x09"), HasSubstr("recalls what it has not remembered"));
  EXPECT_THAT(refusal("]K\1K\2s"s), HasSubstr("adds to what is neither list nor dict"));
  EXPECT_THAT(refusal("\x8a\x09" + std::string(9, 'a')), HasSubstr("a number of more than 64 bits"));
  EXPECT_THAT(refusal("}"), HasSubstr("there is no array of numbers"));
}

// A list in itself, many values, one array under many names, more than the file holds, and every beginning of a file.
TEST(Pickle, HostileOnesAreBounded) {
  EXPECT_THAT(refusal("]q\0h\0a"s), HasSubstr("there is no array of numbers"));
  EXPECT_THAT(refusal(std::string(1'100'000, 'N')), HasSubstr("of more than 1000000 values"));
  EXPECT_THAT(refusal("Nq\0"s +
                      [] {
                        std::string out;
                        for (int k = 0; k < 4'100'000; ++k) out += "h\0"s;
                        return out;
                      }()),
              HasSubstr("of more steps than any recording needs"));
  std::string many = "}(" + text("a") + array({100, 100}, type("u1", "|"), bytes(std::string(10'000, '\1'))) + "q\7";
  for (int k = 0; k < 2000; ++k) many += text("b") + "h\7";
  EXPECT_THAT(refusal(many + "u"), HasSubstr("with the same array many times"));
  EXPECT_THAT(refusal(array({100, 100}, type("f8", "<"), doubles({1}))), HasSubstr("claims 100 x 100 numbers, more than are there"));
  const std::string whole = saved(dict({{"trajectories", kPositions}, {"frames_per_second", small(25)}}));
  for (std::size_t n = 1; n < whole.size(); ++n) EXPECT_NE(error_of(whole.substr(0, n), flags()), "no error") << n;
}

}  // namespace
}  // namespace swarmfit
