// Cameras for the tests, built from their definition, for use between glsl.h and glsl_end.h after core/view.glsl: no
// #pragma once, each test has its own View type.

// An eye at `eye`, turned by `yaw` about +y and then by `pitch` about its own x. depth: 0 standard, 1 reversed, 2
// reversed with an infinite far plane.
inline View makeView(vec2 size, float halfFovY, float nearDistance, float farDistance, int depth,
                     bool orthographic = false, vec3 eye = vec3(0, 0, 0), float yaw = 0, float pitch = 0)
{
    View view;
    vec3 right(cos(yaw), 0, -sin(yaw));
    vec3 back(sin(yaw) * cos(pitch), -sin(pitch), cos(yaw) * cos(pitch));
    vec3 up = cross(back, right);
    view.worldFromView = mat4(vec4(right, 0), vec4(up, 0), vec4(back, 0), vec4(eye, 1));
    mat3 rotation(right, up, back);
    mat3 inverseRotation = transpose(rotation);
    view.viewFromWorld = mat4(vec4(inverseRotation[0], 0), vec4(inverseRotation[1], 0), vec4(inverseRotation[2], 0),
                              vec4(-(inverseRotation * eye), 1));
    view.imageSize = size;
    float slopeY = orthographic ? halfFovY : tan(halfFovY); // orthographic: half the height in metres
    view.slope = vec2(slopeY * size.x / size.y, slopeY);
    view.nearDistance = nearDistance;
    view.farDistance = depth == 2 ? kFarAway : farDistance;
    view.orthographic = orthographic;
    view.reversedDepth = depth != 0;
    float n = nearDistance;
    float f = farDistance;
    if (orthographic) {
        view.depthA = depth == 0 ? -n / (f - n) : f / (f - n);
        view.depthB = depth == 0 ? 1 / (f - n) : -1 / (f - n);
    } else if (depth == 2) {
        view.depthA = 0;
        view.depthB = n;
    } else {
        view.depthA = depth == 0 ? f / (f - n) : -n / (f - n);
        view.depthB = depth == 0 ? -f * n / (f - n) : f * n / (f - n);
    }
    view.clipFromView = mat4(1.0);
    if (!orthographic) {
        view.clipFromView = mat4(vec4(1 / view.slope.x, 0, 0, 0), vec4(0, 1 / view.slope.y, 0, 0),
                                 vec4(0, 0, -view.depthA, -1), vec4(0, 0, view.depthB, 0));
    } else {
        view.clipFromView = mat4(vec4(1 / view.slope.x, 0, 0, 0), vec4(0, 1 / view.slope.y, 0, 0),
                                 vec4(0, 0, -view.depthB, 0), vec4(0, 0, view.depthA, 1));
    }
    return view;
}
