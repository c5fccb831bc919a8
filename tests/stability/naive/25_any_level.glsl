// Replaces: crossray/project/hiz.glsl sanitizeHizSettings
// Fails: the settings' levels are taken at their word; beyond the last there is nothing to read.
HizSettings sanitizeHizSettings(HizSettings settings)
{
    return settings;
}
