# shellcheck shell=bash
# Sourced by the other scripts: where the project is, and how they all configure it.
# One place, so that whatever one script has built is up to date for the next.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Used by the scripts that source this file.
# shellcheck disable=SC2034
build=$project/build/release

# Warnings are errors with the compiler that the project is developed with. Another one may warn of other things, and
# that must not keep anybody from building. TRISMOOTH_WERROR=ON or OFF in the environment decides otherwise.
warnings_as_errors() {
  if [[ -n ${TRISMOOTH_WERROR:-} ]]; then
    echo "$TRISMOOTH_WERROR"
  elif [[ $("${CXX:-c++}" -dumpversion 2>/dev/null) == 12* ]]; then
    echo ON
  else
    echo OFF
  fi
}

configure() {
  (cd "$project" && cmake --preset release "-DTRISMOOTH_WERROR=$(warnings_as_errors)")
}

build_target() {
  (cd "$project" && cmake --build --preset release --target "$1")
}
