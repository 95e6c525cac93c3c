// SPDX-License-Identifier: MIT
#include "libtrack/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/standard_input.h"

namespace swarmfit {
namespace {

std::string because(const std::string& path, const char* what) { return path + ": " + what + ": " + std::strerror(errno); }

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  explicit operator bool() const { return fd_ >= 0; }
  int get() const { return fd_; }
  bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool exists_and_is_no_regular_file(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

// A new name in a folder survives a power cut only when the folder is on the disk. Some file systems cannot do that, which is no failure.
void sync_folder_of(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  const Descriptor folder(::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder) ::fsync(folder.get());
}

// Some files, such as pipes, have no disk behind them.
bool on_the_disk(int fd) { return ::fdatasync(fd) == 0 || errno == EINVAL || errno == EROFS; }

void write_directly(const std::string& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file || !write_all(file.get(), bytes) || !file.close()) throw RunError(because(path, "cannot be written"));
}

// What never ends is refused while there is memory left to say so.
std::size_t most_from_a_pipe() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) / 8 * static_cast<std::size_t>(size) : std::size_t{1} << 30;
}

std::string all_bytes(const std::string& name, int fd) {
  struct stat info {};
  if (::fstat(fd, &info) != 0) throw RunError(because(name, "cannot be read"));
  if (S_ISDIR(info.st_mode)) throw InputError(name + ": is a folder; expected a file");
  if (S_ISBLK(info.st_mode) || (S_ISCHR(info.st_mode) && ::isatty(fd) == 0))
    throw InputError(name + ": is a device; expected a file, or a pipe");

  // The size is a hint only: pipes have none, and a file may grow while it is read.
  const std::size_t most = S_ISREG(info.st_mode) ? std::string().max_size() : most_from_a_pipe();
  std::string bytes(static_cast<std::size_t>(info.st_size) + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size() + 65536);
    const ssize_t n = ::read(fd, bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw RunError(because(name, "cannot be read"));
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used > most) throw InputError(fmt::format("{}: does not end within {} MiB; expected a recording", name, most >> 20U));
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

std::string read_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file && (errno == ENOENT || errno == ENOTDIR)) throw InputError(path + ": no such file; expected the path of a recording");
  if (!file) throw RunError(because(path, "cannot be opened"));
  return all_bytes(path, file.get());
}

std::string read_standard_input() { return all_bytes("standard input", STDIN_FILENO); }

void write_file_atomically(const std::string& path, std::string_view bytes) {
  if (exists_and_is_no_regular_file(path)) return write_directly(path, bytes);
  if (std::error_code none; std::filesystem::is_symlink(path, none)) {  // what it points to is written, and the link stays
    const auto target = std::filesystem::weakly_canonical(path, none);
    if (!none && !std::filesystem::is_symlink(target, none)) return write_file_atomically(target.string(), bytes);
  }
  if (::access(path.c_str(), W_OK) != 0 && errno != ENOENT) throw RunError(because(path, "cannot be written"));
  const std::string temporary = path + '.' + std::to_string(::getpid()) + ".part";
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file) throw RunError(because(path, "cannot be written"));
  const bool done =
      write_all(file.get(), bytes) && ::fsync(file.get()) == 0 && file.close() && std::rename(temporary.c_str(), path.c_str()) == 0;
  if (done) return sync_folder_of(path);
  const auto message = because(path, "cannot be written");
  ::unlink(temporary.c_str());
  throw RunError(message);
}

AppendedFile::AppendedFile(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw RunError(because(path, "cannot be written"));
  sync_folder_of(path);
}

AppendedFile::~AppendedFile() { ::close(descriptor_); }

void AppendedFile::append(std::string_view bytes) {
  if (!write_all(descriptor_, bytes) || !on_the_disk(descriptor_)) throw RunError(because(path_, "cannot be written"));
}

void AppendedFile::truncate(std::size_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) throw RunError(because(path_, "cannot be cut"));
}

void make_directory(const std::string& path) {
  const std::filesystem::path folder = path;
  std::error_code failed;
  if (std::filesystem::is_directory(folder, failed)) return;
  if (folder.has_parent_path() && folder.parent_path() != folder) make_directory(folder.parent_path().string());
  std::filesystem::create_directory(folder, failed);
  if (failed) throw RunError(path + ": cannot create the folder: " + failed.message());
  sync_folder_of(path);
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) throw RunError("SHA-256 is not available");
  static constexpr std::string_view hex = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += hex[digest[i] >> 4];
    text += hex[digest[i] & 15];
  }
  return text;
}

}  // namespace swarmfit
