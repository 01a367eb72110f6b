# SPDX-License-Identifier: Apache-2.0
# The files that the HTML report embeds. The plotting library comes from the npm registry, at the
# version and checksum of web/package-lock.json; without npm the rest is built.
set(web_dir ${PROJECT_SOURCE_DIR}/web)
set(npm_dir ${PROJECT_BINARY_DIR}/web)
set(plotly_dir ${npm_dir}/node_modules/plotly.js-cartesian-dist-min)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${web_dir}/package-lock.json)

file(SHA256 ${web_dir}/package-lock.json lock_hash)
if(NOT EXISTS ${plotly_dir}/plotly-cartesian.min.js OR NOT lock_hash STREQUAL RIDGELINE_NPM_LOCK)
  find_program(RIDGELINE_NPM npm)
  if(RIDGELINE_NPM)
    file(MAKE_DIRECTORY ${npm_dir})
    configure_file(${web_dir}/package.json ${npm_dir}/package.json COPYONLY)
    configure_file(${web_dir}/package-lock.json ${npm_dir}/package-lock.json COPYONLY)
    execute_process(COMMAND ${RIDGELINE_NPM} ci --no-audit --no-fund --omit=dev
                    WORKING_DIRECTORY ${npm_dir} RESULT_VARIABLE npm_result
                    OUTPUT_QUIET ERROR_VARIABLE npm_error)
    if(npm_result EQUAL 0)
      set(RIDGELINE_NPM_LOCK ${lock_hash} CACHE INTERNAL "Lock file of the installed npm packages")
    endif()
  endif()
endif()

set(plotly "")
set(plotly_license "")
if(EXISTS ${plotly_dir}/plotly-cartesian.min.js)
  set(plotly ${plotly_dir}/plotly-cartesian.min.js)
  set(plotly_license ${plotly_dir}/LICENSE)
  set_property(GLOBAL PROPERTY RIDGELINE_PLOTLY_LICENSE ${plotly_license})
elseif(RIDGELINE_NPM)
  message(STATUS "ridgeline: HTML reports are built WITHOUT plots: `npm ci` in web/ failed. "
                 "Check the network and configure again. npm said: ${npm_error}")
else()
  message(STATUS "ridgeline: HTML reports are built WITHOUT plots: npm is missing. "
                 "Install the packages nodejs and npm and configure again.")
endif()

# ridgeline_embed(OUT_VARIABLE NAME INPUT): appends the generated source to OUT_VARIABLE.
function(ridgeline_embed out name input)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cc)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DNAME=${name} -P
            ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${input} ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
    VERBATIM)
  set(${out} ${${out}} ${output} PARENT_SCOPE)
endfunction()
ridgeline_embed(RIDGELINE_WEB_SOURCES kReportBody ${web_dir}/report_body.html)
ridgeline_embed(RIDGELINE_WEB_SOURCES kReportCss ${web_dir}/report.css)
ridgeline_embed(RIDGELINE_WEB_SOURCES kReportJs ${web_dir}/report.js)
ridgeline_embed(RIDGELINE_WEB_SOURCES kReportPlotsJs ${web_dir}/report_plots.js)
ridgeline_embed(RIDGELINE_WEB_SOURCES kReportDetailJs ${web_dir}/report_detail.js)
ridgeline_embed(RIDGELINE_WEB_SOURCES kPlotly "${plotly}")
ridgeline_embed(RIDGELINE_WEB_SOURCES kPlotlyLicense "${plotly_license}")
