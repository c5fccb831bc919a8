// Where the passes find their resources. Unique within set 0, because the translation to OpenGL knows no sets. C++
// reads this file, too.
#ifndef BINDINGS_BINDING_NUMBERS_GLSL
#define BINDINGS_BINDING_NUMBERS_GLSL

const int kParamsBinding = 0;
const int kDepthBinding = 1;
const int kNormalBinding = 2;
const int kColorBinding = 3;
const int kMaskBinding = 4;
const int kMotionBinding = 5;
const int kThicknessBinding = 6;
const int kHistoryColorBinding = 7;
const int kPyramidBinding = 8;
const int kOutputBinding = 9;
const int kProbeAtlasBinding = 10;
const int kPlanarAtlasBinding = 11;
const int kRecordBinding = 12;
const int kSurfaceBinding = 13;
const int kColorPyramidBinding = 14;
const int kOwnStatusBinding = 15;
const int kProbeParamsBinding = 16;
const int kPlanarParamsBinding = 17;

#endif
