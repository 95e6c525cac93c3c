// SPDX-License-Identifier: MIT
// The program run as its user runs it, in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace swarmfit::test {

namespace fs = std::filesystem;

inline std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

struct Result {
  int code;
  std::string out, err;
};

class Program : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    dir_ = fs::temp_directory_path() / ("swarmfit_cli_" + std::to_string(getpid()) + "_" + info->name());
    fs::remove_all(dir_);
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }

  // Runs the program in a folder of its own; `input` is its standard input.
  Result run(const std::string& arguments, const std::string& input = "") const {
    write("stdin", input);
    const std::string command = "cd '" + dir_.string() + "' && '" SWARMFIT_PROGRAM "' " + arguments + " <stdin 2>stderr";
    FILE* pipe = popen(command.c_str(), "r");
    Result result{-1, "", ""};
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) result.out.append(buffer.data(), n);
    result.code = WEXITSTATUS(pclose(pipe));
    result.err = content(dir_ / "stderr");
    return result;
  }

  void write(const std::string& name, const std::string& bytes) const { std::ofstream(dir_ / name, std::ios::binary) << bytes; }

  // Bad input: exit code 2, one line on standard error, nothing on standard output.
  void expect_refused(const std::string& arguments, const std::string& message, const std::string& input = "") const {
    const Result r = run(arguments, input);
    EXPECT_EQ(r.code, 2) << arguments;
    EXPECT_THAT(r.out, testing::IsEmpty()) << arguments;
    EXPECT_THAT(r.err, testing::AllOf(testing::StartsWith("swarmfit: "), testing::HasSubstr(message))) << arguments;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
  }

  fs::path dir_;
};

}  // namespace swarmfit::test
