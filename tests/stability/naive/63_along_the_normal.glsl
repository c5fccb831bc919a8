// Replaces: crossray/probe/planar.glsl makeMirroredView
// Fails: the mirrored camera is built from its view and world up, and along the normal those two have no cross product.
MirroredView makeMirroredView(View view, MirrorPlane plane)
{
    mat4 reflection = makeReflectionMatrix(plane);
    vec3 eye = (reflection * view.worldFromView[3]).xyz;
    vec3 backward = (reflection * view.worldFromView[2]).xyz;
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), backward));
    vec3 up = cross(backward, right);
    View mirrored = view;
    mirrored.worldFromView = mat4(vec4(right, 0.0), vec4(-up, 0.0), vec4(backward, 0.0), vec4(eye, 1.0));
    mirrored.viewFromWorld = inverse(mirrored.worldFromView);
    return MirroredView(mirrored, kPlanarOk);
}
