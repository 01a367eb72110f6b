# SPDX-License-Identifier: Apache-2.0
# cmake -DEXAMPLE=... -DREADME=... -P: the README shows the lines of the example between its marks.
file(READ ${EXAMPLE} example)
file(READ ${README} readme)
string(REGEX MATCH "// \\[README\n(.*)\n  // README\\]" found "${example}")
if(NOT found)
  message(FATAL_ERROR "${EXAMPLE}: no lines between \"// [README\" and \"// README]\"")
endif()
string(REGEX REPLACE "(^|\n)  " "\\1" lines "${CMAKE_MATCH_1}")
string(FIND "${readme}" "```cpp\n${lines}\n```" at)
if(at EQUAL -1)
  message(FATAL_ERROR "${README}: expected, as in ${EXAMPLE}:\n```cpp\n${lines}\n```")
endif()
