// Replaces: crossray/probe/urp.glsl urpProbeComesFirst
// Fails: each of two equals comes before the other, so that the last that is asked is first.
bool urpProbeComesFirst(UrpProbe a, UrpProbe b, int profile)
{
    if (a.importance != b.importance) return a.importance > b.importance;
    return computeUrpSize(a, profile) <= computeUrpSize(b, profile);
}
