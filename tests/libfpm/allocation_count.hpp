#pragma once

// Number of heap allocations of this process so far, by new, malloc or any library.
long allocation_count();

// Bytes on the heap now, as far as the program can use them; not under a sanitizer.
long allocated_bytes();
