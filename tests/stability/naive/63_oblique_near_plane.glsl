// Replaces: crossray/probe/planar.glsl makeObliqueProjection
// Fails: the row is that of one convention of depth, so that in the others the near plane is the far one.
ObliqueProjection makeObliqueProjection(View mirroredView, MirrorPlane plane)
{
    mat4 clip = mirroredView.clipFromView;
    vec3 nVS = directionVSFromWS(mirroredView, plane.normalWS);
    vec4 planeVS = vec4(nVS, -dot(nVS, positionVSFromWS(mirroredView, plane.pointWS)));
    vec4 corner = inverse(clip) * vec4(sign(nVS.x), sign(nVS.y), 1.0, 1.0);
    vec4 row = planeVS * (1.0 / dot(planeVS, corner));
    return ObliqueProjection(withDepthRow(clip, row), kPlanarOk);
}
