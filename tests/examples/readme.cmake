# SPDX-License-Identifier: Apache-2.0
# cmake -DEXAMPLE=... -DREADME=... -P: the README shows the lines of the example between its marks.
file(READ ${EXAMPLE} example)
file(READ ${README} readme)
string(REGEX MATCH "// \\[README\n(.*)\n  // README\\]" found "${example}")
if(NOT found)
  message(FATAL_ERROR "${EXAMPLE}: no lines between \"// [README\" and \"// README]\"")
endif()
string(REPLACE "\n  " "\n" lines "\n${CMAKE_MATCH_1}")
string(FIND "${readme}" "```cpp${lines}\n```" at)
if(at EQUAL -1)
  message(FATAL_ERROR "${README}: expected, as in ${EXAMPLE}:\n```cpp${lines}\n```")
endif()
