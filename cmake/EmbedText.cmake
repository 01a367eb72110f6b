# SPDX-License-Identifier: Apache-2.0
# Run as a script: writes OUTPUT, a C++ source that defines `const std::string_view NAME` in the
# namespace ridgeline::web with the bytes of INPUT (empty where INPUT is "").
set(array "")
if(NOT INPUT STREQUAL "")
  file(READ ${INPUT} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," array "${hex}")
endif()
file(WRITE ${OUTPUT}
"#include \"report/web_files.h\"
namespace ridgeline::web {
namespace {
constexpr unsigned char kBytes[] = {${array}0};
}  // namespace
const std::string_view ${NAME}{reinterpret_cast<const char*>(kBytes), sizeof kBytes - 1};
}  // namespace ridgeline::web
")
