// One owner for every GL name. The context in which a name was made is current when its owner dies.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace crossray {

template <void (*Destroy)(GLuint)>
class GlName {
  public:
    GlName() = default;
    explicit GlName(GLuint id) : id_(id) {}
    GlName(GlName&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlName& operator=(GlName&& other) noexcept
    {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlName()
    {
        if (id_) Destroy(id_);
    }
    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

// Functions, since glad's own names are variables that are filled when a context is opened.
inline void deleteGlBuffer(GLuint id)
{
    glDeleteBuffers(1, &id);
}
inline void deleteGlTexture(GLuint id)
{
    glDeleteTextures(1, &id);
}
inline void deleteGlSampler(GLuint id)
{
    glDeleteSamplers(1, &id);
}
inline void deleteGlShader(GLuint id)
{
    glDeleteShader(id);
}
inline void deleteGlProgram(GLuint id)
{
    glDeleteProgram(id);
}

using GlBufferName = GlName<deleteGlBuffer>;
using GlTextureName = GlName<deleteGlTexture>;
using GlSamplerName = GlName<deleteGlSampler>;
using GlShaderName = GlName<deleteGlShader>;
using GlProgramName = GlName<deleteGlProgram>;

} // namespace crossray
