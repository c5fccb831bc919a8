#include "harness/cli/command_line.h"

int main(int argc, char** argv)
{
    return crossray::runCommandLine(argc, argv);
}
