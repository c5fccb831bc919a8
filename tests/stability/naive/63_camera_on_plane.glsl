// Replaces: pass/planar_tier.glsl findInPlanarImage
// Fails: the camera is mirrored whatever side of the plane it is on, and a probe that looks from inside the wall answers.
PlanarLookup findInPlanarImage(View view, int item, int planar, vec3 originWS, vec3 dirWS)
{
    mat4 reflection = makeReflectionMatrix(loadMirrorPlane(planar));
    View mirrored = view;
    mirrored.viewFromWorld = view.viewFromWorld * reflection;
    mirrored.worldFromView = reflection * view.worldFromView;
    return lookUpPlanar(mirrored, mirrored.clipFromView, originWS + dirWS * 1000.0, dirWS);
}
