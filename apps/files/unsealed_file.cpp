#include "files/unsealed_file.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

namespace files {

namespace {

constexpr int copied = 0;
constexpr int refused = 1;  // for the reason in the pipe

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

template <class T>
void copy_values(const Hdf5File& from, Hdf5File& to, const std::string& path,
                 const DatasetInfo& info) {
  const std::vector<T> values = from.read_all<T>(path);
  to.write<T>(path, values, info.shape, info.unit);
}

void copy_dataset(const Hdf5File& from, Hdf5File& to, const std::string& path) {
  const DatasetInfo info = from.info(path);
  if (info.type == "float64") return copy_values<double>(from, to, path, info);
  if (info.type == "float32") return copy_values<float>(from, to, path, info);
  if (info.type == "int64") return copy_values<std::int64_t>(from, to, path, info);
  if (info.type == "int32") return copy_values<std::int32_t>(from, to, path, info);
  if (info.type == "uint8") return copy_values<std::uint8_t>(from, to, path, info);
  if (info.type == "text") return to.write_text(path, from.read_text(path));
  throw FileError(from.file(), path + " holds " + info.type + ", which is not used here");
}

void copy_attributes(const Hdf5File& from, Hdf5File& to, const std::string& path) {
  for (const std::string& name : from.list_attributes(path)) {
    if (!to.has_attribute(path, name)) {  // a unit goes with its dataset
      to.write_attribute(path, name, from.read_attribute(path, name));
    }
  }
}

void copy_group(const Hdf5File& from, Hdf5File& to, const std::string& group) {
  to.make_group(group);
  copy_attributes(from, to, group);
  for (const std::string& name : from.list(group)) {
    const std::string path = (group == "/" ? "" : group) + "/" + name;
    if (from.is_group(path)) {
      copy_group(from, to, path);
    } else {
      copy_dataset(from, to, path);
      copy_attributes(from, to, path);
    }
  }
}

/// The child's whole work. The pipe holds far more than the reason, so that writing it cannot wait.
int copy_or_say_why(const CopyHdf5& copy, const std::filesystem::path& from,
                    const std::filesystem::path& to, int reason) {
  std::string text;
  try {
    copy(from, to);
    return copied;
  } catch (const FileError& failure) {
    text = failure.reason();
  } catch (const std::exception& failure) {
    text = fmt::format("cannot be read: {}", failure.what());
  }
  return ::write(reason, text.data(), text.size()) < 0 ? copied - 1 : refused;
}

std::string all_of(int pipe) {
  std::string text;
  std::array<char, 512> piece{};
  for (;;) {
    const ssize_t got = ::read(pipe, piece.data(), piece.size());
    if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR)) return text;
  }
}

int status_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

void require_copied(const std::filesystem::path& file, int status, const std::string& reason) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == copied) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == refused) throw FileError(file, reason);
  const std::string how = WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : "no reason given";
  throw FileError(file, fmt::format("is damaged: HDF5 falls on it ({})", how));
}

}  // namespace

void copy_contents(const std::filesystem::path& from, const std::filesystem::path& to) {
  const Hdf5File original = Hdf5File::open(from);
  Hdf5File made = Hdf5File::create(to);
  copy_group(original, made, "/");
  made.close();
}

Hdf5File open_unsealed(const std::filesystem::path& file, const CopyHdf5& copy) {
  const Descriptor memory(::memfd_create("copy", MFD_CLOEXEC));
  std::array<int, 2> ends{-1, -1};
  if (memory.number() < 0 || ::pipe(ends.data()) != 0) {
    throw system_error(file, "cannot be copied into memory", errno);
  }
  const Descriptor from_child(ends[0]);
  Descriptor to_parent(ends[1]);
  const std::filesystem::path in_memory = fmt::format("/proc/self/fd/{}", memory.number());
  const pid_t child = ::fork();
  if (child < 0) throw system_error(file, "cannot be read in a process of its own", errno);
  if (child == 0) ::_exit(copy_or_say_why(copy, file, in_memory, to_parent.number()));
  to_parent.close();
  const std::string reason = all_of(from_child.number());
  require_copied(file, status_of(child), reason);
  return Hdf5File::open_copy(in_memory, file);
}

}  // namespace files
