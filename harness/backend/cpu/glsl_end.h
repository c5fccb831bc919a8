// Ends what harness/backend/cpu/glsl.h began.
#pragma once

} // namespace
#if CROSSRAY_GLSL_PRECISION == 64
} // namespace crossray::cpu64
#undef float
#else
} // namespace crossray::cpu32
#endif
#pragma GCC diagnostic pop
#undef glm
