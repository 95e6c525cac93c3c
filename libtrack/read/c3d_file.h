// SPDX-License-Identifier: MIT
// C3D, the binary files of motion capture: a header of 512 bytes, a section of parameters, then frames of points and of analog samples,
// written by Intel, DEC or MIPS machines. After the C3D User Guide of Motion Lab Systems (https://www.c3d.org).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// One parameter: its numbers, or its texts.
struct C3dParameter {
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

class C3dFile {
 public:
  // Throws InputError at `name` where the file is cut short or contradicts itself. Keeps a view of `bytes`.
  C3dFile(const std::string& name, std::string_view bytes);

  std::size_t points() const { return points_; }  // per frame
  std::size_t frames() const { return frames_; }
  double first_frame() const { return first_; }

  // x, y and z in the file's unit; nothing where the point was not seen. `frame` from 0.
  struct Point {
    double x, y, z;
  };
  std::optional<Point> at(std::size_t frame, std::size_t point) const;

  double rate() const { return rate_; }  // frames per second; 0: not stated
  // Of the group POINT, in any case; nullptr: there is none.
  const C3dParameter* parameter(std::string_view name) const;

 private:
  enum class Machine { intel = 84, dec = 85, mips = 86 };
  struct Named {
    std::string group, name;  // upper case
    C3dParameter value;
  };

  [[noreturn]] void damaged(const std::string& what) const;
  std::size_t byte(std::size_t at) const;
  std::size_t word(std::size_t at) const;  // 16 bits, unsigned
  double number(std::size_t at) const;     // 4 bytes
  static double whole(std::size_t word) { return word < 0x8000 ? static_cast<double>(word) : static_cast<double>(word) - 0x10000; }

  void read_parameters(std::size_t start);
  C3dParameter read_values(std::size_t& at) const;
  void read_layout();
  double claimed_frames() const;
  const C3dParameter* find(std::string_view group, std::string_view name) const;
  double first_number(std::string_view group, std::string_view name, double otherwise) const;

  const std::string& name_;
  std::string_view bytes_;
  Machine machine_ = Machine::intel;
  std::vector<Named> parameters_;
  std::size_t points_ = 0, frames_ = 0, data_ = 0, frame_bytes_ = 0;
  double first_ = 1, rate_ = 0, scale_ = 1;
  bool floating_ = false;
};

// Whether the file says that it is one.
bool is_c3d(std::string_view bytes);

}  // namespace swarmfit
