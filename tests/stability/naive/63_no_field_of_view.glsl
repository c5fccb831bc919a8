// Replaces: pass/planar_tier.glsl loadCaptureView
// Fails: a field of view of 0 is taken for one that is not set, and the camera's own image is read in its place.
View loadCaptureView(View view, int planar)
{
    vec4 field = planarParams.items[planar].field;
    float slope = field.x > 0.0 ? tan(0.5 * field.x) : view.slope.y;
    View capture = view;
    capture.slope = vec2(slope * view.slope.x / view.slope.y, slope);
    capture.clipFromView[0].x = 1.0 / capture.slope.x;
    capture.clipFromView[1].y = 1.0 / capture.slope.y;
    return capture;
}
