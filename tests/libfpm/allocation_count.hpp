#pragma once

// Number of heap allocations of this process so far, by new, malloc or any library.
long allocation_count();
