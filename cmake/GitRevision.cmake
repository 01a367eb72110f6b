# SPDX-License-Identifier: Apache-2.0
# ridgeline_git_revision(SOURCE VERSION OUT): what git adds to the version: "" at the clean tag
# v<VERSION>, else "+<commits since it>.g<commit>", or "+g<commit>" without such a tag, and ".dirty"
# where files are changed. "" where there is no git or no repository: a release archive.
function(ridgeline_git_revision source version out)
  set(revision "")
  set(git ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 git -C ${source})
  # A folder of somebody else's repository is not ours.
  execute_process(COMMAND ${git} rev-parse --show-prefix OUTPUT_VARIABLE prefix ERROR_QUIET
                  RESULT_VARIABLE result OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(result EQUAL 0 AND prefix STREQUAL "")
    execute_process(COMMAND ${git} describe --tags --long --dirty --match v${version} --always
                            --abbrev=9
                    OUTPUT_VARIABLE described ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(described MATCHES "^v.*-([0-9]+)-g([0-9a-f]+)(-dirty)?$")
      if(NOT CMAKE_MATCH_1 EQUAL 0 OR CMAKE_MATCH_3)
        set(revision "+${CMAKE_MATCH_1}.g${CMAKE_MATCH_2}")
      endif()
    elseif(described MATCHES "^([0-9a-f]+)(-dirty)?$")
      set(revision "+g${CMAKE_MATCH_1}")
    endif()
    if(described MATCHES "-dirty$")
      string(APPEND revision ".dirty")
    endif()
  endif()
  set(${out} "${revision}" PARENT_SCOPE)
endfunction()
