#define CROSSRAY_GLSL_PRECISION 32
#include "harness/backend/cpu/kernels.inl"
