// Replaces: crossray/project/hiz.glsl stepHiz
// Fails: a level up after every cell, also after one that had to be looked into: the next needs the same look, and each
// pixel costs a climb and a descent.
HizState stepHiz(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, HizTest test, HizSettings settings)
{
    bool isSkipped = test.kind == kIntersectionNone;
    bool descends = !isSkipped && state.level > settings.minLevel;
    int levelAfter = descends ? state.level - 1 : min(state.level + 1, settings.maxLevel);
    return HizState(descends ? state.s : cell.leave, descends ? state.pixel : cell.leavePixel, levelAfter, test.inFront,
                    test.attached, state.wasHidden || (test.isHidden && !descends), state.isStart && descends);
}
