#include "trismooth/pipeline/cli/command_line.h"

int main(int argc, char** argv) {
  return trismooth::run_command_line(argc, argv);
}
