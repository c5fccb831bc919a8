// Replaces: crossray/project/screen_ray.glsl borderTime
// Replaces: crossray/core/math.glsl awayFromZero
// Fails: along the axis in which the ray does not move, the distance to a border is divided by 0, and its sign decides.
float borderTime(float start, float delta, int border)
{
    return (float(border) - start) / delta;
}

float awayFromZero(float x, float smallest)
{
    return x;
}
