#define CROSSRAY_GLSL_PRECISION 64
#include "harness/backend/cpu/kernels.inl"
