// Errors that end in one clear line and an exit code. A logic error asserts; a broken input throws one of these; a
// likely local failure (a file that may be missing, a hit that may not be) is a return value.
#pragma once

#include <stdexcept>
#include <string>

namespace crossray {

// Where in a person's file something stands. Lines and columns count from 1; 0 means "the whole file".
struct SourcePosition {
    std::string file;
    int line = 0;
    int column = 0;

    // "file:line:column", shortened by what is 0; empty when there is no file.
    std::string format() const;
};

// Exit codes of the command line, as a contract.
enum class ExitCode : int {
    kAsExpected = 0,
    kFailed = 1,
    kUsage = 2,
    kEnvironment = 3,
    kNothingSelected = 4,
    kInterrupted = 130,
};

// Base of all errors thrown on purpose. what() is the whole line "file:line:column: text", without a line break at its
// end.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const SourcePosition& position, const std::string& text);
    ExitCode exitCode() const { return code_; }
    const SourcePosition& position() const { return position_; }

  private:
    ExitCode code_;
    SourcePosition position_;
};

// Bad input: a case file, a G-buffer, a command line. Exit 2. One line: what it quotes of the input may have line
// breaks and other control characters, which are blanks here.
class InputError : public Error {
  public:
    InputError(const SourcePosition& position, const std::string& text);
    explicit InputError(const std::string& text) : InputError(SourcePosition{}, text) {}
};

// A shader that does not compile, link or validate. The text may have several lines, each "file:line:column: error:
// text" of the source that the person wrote.
class ShaderError : public Error {
  public:
    explicit ShaderError(const std::string& text) : Error(ExitCode::kUsage, SourcePosition{}, text) {}
};

// The machine lacks something: a driver, a library, a writable folder. Exit 3.
class EnvironmentError : public Error {
  public:
    explicit EnvironmentError(const std::string& text) : Error(ExitCode::kEnvironment, SourcePosition{}, text) {}
};

} // namespace crossray
