#pragma once

// One binary serves every x86-64: what is hot is compiled for several instruction sets, too, and
// chosen when the program runs. Inlined into functions of these alone (`flatten`), as what is
// called would be compiled for any processor.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__)
#define EQUILIBRIUM_WIDE_LOOPS
#define EQUILIBRIUM_AVX2 __attribute__((target("arch=x86-64-v3")))
#define EQUILIBRIUM_AVX512 __attribute__((target("arch=x86-64-v4")))
#else
#define EQUILIBRIUM_AVX2
#define EQUILIBRIUM_AVX512
#endif
