// Replaces: crossray/project/color_pyramid.glsl reduceColorPyramidCell
// Fails: `continue` skips the step of the while loop as well, and the driver ends it without a word.
vec4 reduceColorPyramidCell(ivec2 cell)
{
    ivec2 finerSize = max(finerColorSize(), ivec2(1));
    ivec2 size = max(finerSize / 2, ivec2(1));
    ivec2 begin = cell * 2;
    ivec2 end = ivec2(cell.x == size.x - 1 ? finerSize.x : begin.x + 2, cell.y == size.y - 1 ? finerSize.y : begin.y + 2);
    vec4 sum = vec4(0.0);
    float count = 0.0;
    for (int y = begin.y; y < end.y; ++y) {
        int x = begin.x;
        while (x < end.x) {
            vec4 finer = fetchFinerColor(ivec2(x, y));
            if (finer.w == 0.0) continue;
            sum += vec4(finer.xyz * finer.w, finer.w);
            count += 1.0;
            ++x;
        }
    }
    return count > 0.0 ? vec4(sum.xyz / sum.w, sum.w / count) : vec4(0.0);
}
