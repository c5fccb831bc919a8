#include "harness/backend/gl/gl_limits.h"

#include <glad/gl.h>

namespace crossray {
namespace {

int64_t readInteger(GLenum name)
{
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value;
}

std::array<int64_t, 3> readTriple(GLenum name)
{
    std::array<int64_t, 3> triple{};
    for (GLuint axis = 0; axis < 3; ++axis) {
        GLint value = 0;
        glGetIntegeri_v(name, axis, &value);
        triple[axis] = value;
    }
    return triple;
}

} // namespace

GlLimits readGlLimits()
{
    GlLimits limits;
    limits.storageBlocks = readInteger(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
    limits.storageBindings = readInteger(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
    limits.storageBytes = readInteger(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    limits.uniformBindings = readInteger(GL_MAX_UNIFORM_BUFFER_BINDINGS);
    limits.uniformBytes = readInteger(GL_MAX_UNIFORM_BLOCK_SIZE);
    limits.textureUnits = readInteger(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    limits.textureSide = readInteger(GL_MAX_TEXTURE_SIZE);
    limits.groupInvocations = readInteger(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
    limits.groupSize = readTriple(GL_MAX_COMPUTE_WORK_GROUP_SIZE);
    limits.groupCount = readTriple(GL_MAX_COMPUTE_WORK_GROUP_COUNT);
    return limits;
}

} // namespace crossray
