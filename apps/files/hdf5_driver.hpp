#pragma once

// Private to the HDF5 layer: how HDF5 reaches the disk.

#include <hdf5.h>

#include "files/system_calls.hpp"

namespace files::hdf5 {

/// What became of the opening and writing of one file; outlives the file's handle.
struct DriverReport {
  int not_opened = 0;  // errno of the last opening (HDF5 tries several), or 0
  int failure = 0;     // errno of the first other call that failed, or 0
};

/// Makes a file access list use a driver of ours, which writes through `system`, so that a disk
/// fills up here as it does for every other file. After its first failure, which it reports, a file
/// takes and forgets all else: HDF5 can then close it, where a failing write would leave it open
/// until the end of the process. It takes no lock: files are written under another name, and some
/// network disks have none.
/// @param system, report  must outlive the file
/// @return negative if HDF5 refuses
herr_t use_driver(hid_t access_list, const SystemCalls& system, DriverReport& report);

}  // namespace files::hdf5
