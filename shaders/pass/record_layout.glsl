// Where the record of a pixel keeps what: vec4 numbers, first of the header, then of each step. C++ reads this file, too.
#ifndef PASS_RECORD_LAYOUT_GLSL
#define PASS_RECORD_LAYOUT_GLSL

const int kRecordClass = 0;     // tracing model, hit class, hit reason, 1 where the pixel traces a ray
const int kRecordStart = 1;     // start on screen (px, px), its linear depth (m), way in the material before it (m)
const int kRecordDirSS = 2;     // unit direction on screen, change of affine depth a pixel, way to the ray's end (px)
const int kRecordOriginWS = 3;  // start in world space
const int kRecordDirWS = 4;     // unit direction in world space
const int kRecordLimits = 5;    // minimum level, maximum level, maximum iterations, thickness (m)
const int kRecordProxy = 6;     // projection distance (m), 1 where the ray meets the proxy
const int kRecordEnd = 7;       // end on screen (px, px), linear depth of the hit (m), hit weight
const int kRecordColor = 8;     // sampled colour, its weight
const int kRecordCounts = 9;    // iterations, coarsest level used, last intersection kind, confidence
const int kRecordHeaderSize = 10;

const int kRecordStepPlace = 0; // position on screen (px, px), the ray's linear depth there (m), level
const int kRecordStepDepth = 1; // depth buffer: nearest, farthest, nearest and the thickness (m), intersection kind
const int kRecordStepCell = 2;  // cell, its size (px, px)
const int kRecordStepSize = 3;

#endif
