// The specialization constants of the harness's passes: CROSSRAY_VARIANT(id, name, default). Included once for each meaning that
// the macro is given (a constant in GLSL; a variable and a table row in C++), so it has no guard.
#ifndef CROSSRAY_VARIANT
#define CROSSRAY_VARIANT(id, name, value) layout(constant_id = id) const int name = value;
#endif

CROSSRAY_VARIANT(0, kEffect, 0)           // 0 reflection, 1 refraction
CROSSRAY_VARIANT(1, kRefractionModel, 0)  // 0 none, 1 sphere, 2 box, 3 thin
CROSSRAY_VARIANT(2, kProjectionModel, 0)  // 0 none, 1 infinite, 2 box, 3 sphere, 4 HiZ, 5 linear, 6 patches, 7 proxy of a probe, 8 own
CROSSRAY_VARIANT(3, kOutputMask, 2097151) // bit i: output i is stored; crossray/shared/outputs.glsl
CROSSRAY_VARIANT(4, kOrthographic, 0)     // 1: View.orthographic
CROSSRAY_VARIANT(5, kReversedDepth, 1)    // 1: View.reversedDepth
CROSSRAY_VARIANT(6, kScreenWeightForm, 1) // 0 linear, 1 smooth as of 2018, 2 smooth as of today
CROSSRAY_VARIANT(7, kThicknessMap, 0)     // 1: the thickness comes from an image
CROSSRAY_VARIANT(8, kFresnel, 0)          // 0 none, 1 exact, 2 Schlick
CROSSRAY_VARIANT(9, kColorSource, 0)      // 0 this frame, or the previous one by 1 motion vectors, 2 its view-projection
CROSSRAY_VARIANT(10, kHierarchy, 0)       // sum of 1 screen, 2 probes, 4 sky; 0: the projection alone
CROSSRAY_VARIANT(11, kSkyModel, 1)        // 0 none, 1 gradient, 2 cubemap
CROSSRAY_VARIANT(16, kPlanarTier, 0)      // 1: there are planar probes
CROSSRAY_VARIANT(20, kRecordPixel, 0)     // 1: records the pixel params.record and stores no plane
CROSSRAY_VARIANT(26, kProbeProfile, 0)    // 0 HDRP, 1 Built-in, 2 URP's manual, 3 URP's code
CROSSRAY_VARIANT(27, kProfileSwitches, 3) // bits of pass/probe_profiles.glsl
