#include "faulty_system.hpp"

#include <cerrno>
#include <map>
#include <memory>

namespace restart {

namespace {

/// Counts the calls and knows the path of each open file.
struct Ledger {
  Fate fate;
  std::int64_t calls = 0;
  std::map<int, std::string> paths;

  /// The fault of the next call; sets errno if it fails.
  Fault next(const std::string& name, const std::string& path) {
    const Fault fault = fate(calls++, Call{name, path});
    if (fault.kind == Fault::Kind::fails) errno = fault.number;
    return fault;
  }
  bool fails(const std::string& name, const std::string& path) {
    return next(name, path).kind == Fault::Kind::fails;
  }
};

}  // namespace

files::SystemCalls faulty_system(Fate fate) {
  const auto ledger = std::make_shared<Ledger>(Ledger{std::move(fate), 0, {}});
  const files::SystemCalls& real = files::system_calls();
  files::SystemCalls faulty = real;
  faulty.open = [=, &real](const char* path, int flags, mode_t mode) {
    if (ledger->fails("open", path)) return -1;
    const int file = real.open(path, flags, mode);
    ledger->paths[file] = path;
    return file;
  };
  faulty.pwrite = [=, &real](int file, const void* bytes, size_t count, off_t at) -> ssize_t {
    const Fault fault = ledger->next("pwrite", ledger->paths[file]);
    if (fault.kind == Fault::Kind::fails) return -1;
    const bool short_of = fault.kind == Fault::Kind::falls_short && count > 1;
    return real.pwrite(file, bytes, short_of ? count / 2 : count, at);
  };
  faulty.ftruncate = [=, &real](int file, off_t size) {
    return ledger->fails("ftruncate", ledger->paths[file]) ? -1 : real.ftruncate(file, size);
  };
  faulty.fsync = [=, &real](int file) {
    return ledger->fails("fsync", ledger->paths[file]) ? -1 : real.fsync(file);
  };
  faulty.close = [=, &real](int file) {
    // As on Linux, a file whose closing fails is closed.
    const bool fails = ledger->fails("close", ledger->paths[file]);
    const int closed = real.close(file);
    return fails ? -1 : closed;
  };
  faulty.rename = [=, &real](const char* from, const char* to) {
    return ledger->fails("rename", to) ? -1 : real.rename(from, to);
  };
  faulty.unlink = [=, &real](const char* path) {
    return ledger->fails("unlink", path) ? -1 : real.unlink(path);
  };
  return faulty;
}

std::vector<Call> calls_of(const std::function<void(const files::SystemCalls&)>& work) {
  std::vector<Call> calls;
  work(faulty_system([&](std::int64_t, const Call& call) {
    calls.push_back(call);
    return Fault{};
  }));
  return calls;
}

}  // namespace restart
