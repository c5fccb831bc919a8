#include "harness/cli/command_line.h"

#include <csignal>

int main(int argc, char** argv)
{
    // A file that may not grow is an error of the write, with the file's name. Workers inherit it.
    std::signal(SIGXFSZ, SIG_IGN);
    return crossray::runCommandLine(argc, argv);
}
