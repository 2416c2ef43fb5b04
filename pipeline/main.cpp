#include "trismooth/pipeline/command_line.h"

int main(int argc, char** argv) {
  return trismooth::run_command_line(argc, argv);
}
