// Replaces: crossray/project/march_end.glsl computeMarchClass
// Fails: the march returns its last position when its steps are used up; nothing was met there.
int computeMarchClass(int reason)
{
    bool isOut = reason == kHitReasonOffScreen || reason == kHitReasonSky;
    return isOut ? kHitClassMiss : kHitClassHit;
}
