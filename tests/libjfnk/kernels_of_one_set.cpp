// The kernels of libjfnk as the compiler makes them for one instruction set (KERNEL_SET), without
// the choice at run time.
#include <Eigen/Core>

#define JFNK_TARGET_CLONES
#define detail KERNEL_SET
#include "block_kernels.cpp"
