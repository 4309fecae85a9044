#include "files/hdf5_driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <span>

#include "files/output_file.hpp"

// HDF5 calls these as C functions; none may let an exception through.
namespace files::hdf5 {

namespace {

constexpr mode_t readable_by_all = 0666;  // less the user's umask

/// What an access list carries to the driver.
struct DriverInfo {
  const SystemCalls* system;
  DriverReport* report;
};

/// An open file; HDF5 sees its base.
struct OpenFile : H5FD_t {
  DriverInfo info{};
  int number = -1;
  bool writable = false;
  struct stat status {};
  haddr_t allocated = 0;  // bytes that HDF5 has handed out ("end of allocation")
  haddr_t size = 0;       // of the file on disk
};

OpenFile& of(H5FD_t* file) {
  return *static_cast<OpenFile*>(file);
}
const OpenFile& of(const H5FD_t* file) {
  return *static_cast<const OpenFile*>(file);
}

void note(OpenFile& file, int failure) {
  if (file.info.report->failure == 0) file.info.report->failure = failure;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access_list, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access_list));
  if (info == nullptr) return nullptr;
  int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
  if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT;
  if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
  if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
  auto file = std::make_unique<OpenFile>();
  file->info = *info;
  file->number = info->system->open(name, mode, readable_by_all);
  const bool opened = file->number >= 0 && ::fstat(file->number, &file->status) == 0;
  info->report->not_opened = opened ? 0 : errno;
  if (!opened) {
    if (file->number >= 0) info->system->close(file->number);
    return nullptr;
  }
  file->writable = (flags & H5F_ACC_RDWR) != 0;
  file->size = static_cast<haddr_t>(file->status.st_size);
  return file.release();
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<OpenFile> file(&of(base));
  // HDF5 opens a file once for several readers: whose report this was may be gone.
  if (file->info.system->close(file->number) != 0 && file->writable) note(*file, errno);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const auto key = [](const H5FD_t* file) {
    return std::pair(of(file).status.st_dev, of(file).status.st_ino);
  };
  return key(a) < key(b) ? -1 : key(b) < key(a) ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated_size(const H5FD_t* file, H5FD_mem_t) {
  return of(file).allocated;
}
herr_t set_allocated_size(H5FD_t* file, H5FD_mem_t, haddr_t size) {
  of(file).allocated = size;
  return 0;
}
haddr_t size_on_disk(const H5FD_t* file, H5FD_mem_t) {
  return of(file).size;
}

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t at, size_t count, void* buffer) {
  OpenFile& file = of(base);
  auto rest = std::span(static_cast<std::byte*>(buffer), count);
  while (!rest.empty()) {
    const ssize_t got = ::pread(file.number, rest.data(), rest.size(), static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    rest = rest.subspan(static_cast<std::size_t>(got));
    at += static_cast<haddr_t>(got);
  }
  std::ranges::fill(rest, std::byte{0});  // beyond the end, as HDF5 wants it
  return 0;
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t at, size_t count, const void* buffer) {
  OpenFile& file = of(base);
  if (file.info.report->failure == 0) {
    const auto bytes = std::span(static_cast<const std::byte*>(buffer), count);
    note(file, write_all(*file.info.system, file.number, bytes, static_cast<off_t>(at)));
  }
  file.size = std::max(file.size, at + count);
  return 0;
}

herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  OpenFile& file = of(base);
  if (file.size == file.allocated) return 0;
  if (file.info.report->failure == 0 &&
      file.info.system->ftruncate(file.number, static_cast<off_t>(file.allocated)) != 0) {
    note(file, errno);
  }
  file.size = file.allocated;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "fpm";
  driver.maxaddr = HADDR_MAX / 4;  // of a signed offset
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = allocated_size;
  driver.set_eoa = set_allocated_size;
  driver.get_eof = size_on_disk;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = truncate;
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), driver.fl_map);
  return driver;
}

hid_t registered_driver() {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  return id;
}

}  // namespace

herr_t use_driver(hid_t access_list, const SystemCalls& system, DriverReport& report) {
  const DriverInfo info{&system, &report};
  return H5Pset_driver(access_list, registered_driver(), &info);
}

}  // namespace files::hdf5
