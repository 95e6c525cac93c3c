# SPDX-License-Identifier: MIT
# Builds the report's page, style sheet and script, and Chart.js from the system's package, into the library report_assets: one of its
# own, because a target with generated sources is not compiled before all it depends on is built.
find_file(SWARMFIT_CHART_JS NAMES chart.min.js Chart.min.js chart.umd.js
          PATHS /usr/share/javascript/chart.js /usr/share/nodejs/chart.js/dist NO_DEFAULT_PATH
          DOC "Chart.js 3 or 4 as one script for browsers")
if(NOT SWARMFIT_CHART_JS)
  message(FATAL_ERROR "Chart.js is missing: install the package libjs-chart.js, or give its file by -DSWARMFIT_CHART_JS=.../chart.min.js")
endif()
file(READ "${SWARMFIT_CHART_JS}" start LIMIT 200)
if(NOT start MATCHES "Chart\\.js v[34]\\.")
  message(FATAL_ERROR "${SWARMFIT_CHART_JS} is not Chart.js 3 or 4; expected the file of Debian 12's package libjs-chart.js (3.9)")
endif()

add_library(report_assets STATIC)
target_link_libraries(report_assets PUBLIC swarmfit_flags)

function(embed_asset name input)
  set(output ${CMAKE_BINARY_DIR}/generated/reports/${name}.cpp)
  add_custom_command(OUTPUT ${output}
                     COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DNAME=${name} -P ${CMAKE_SOURCE_DIR}/reports/assets/embed.cmake
                     DEPENDS ${input} ${CMAKE_SOURCE_DIR}/reports/assets/embed.cmake VERBATIM)
  target_sources(report_assets PRIVATE ${output})
endfunction()

embed_asset(report_html ${CMAKE_SOURCE_DIR}/reports/assets/report.html)
embed_asset(across_html ${CMAKE_SOURCE_DIR}/reports/assets/across.html)
embed_asset(tracks_html ${CMAKE_SOURCE_DIR}/reports/assets/tracks.html)
embed_asset(gallery_html ${CMAKE_SOURCE_DIR}/reports/assets/gallery.html)
embed_asset(evaluation_html ${CMAKE_SOURCE_DIR}/reports/assets/evaluation.html)
embed_asset(study_html ${CMAKE_SOURCE_DIR}/reports/assets/study.html)
embed_asset(report_css ${CMAKE_SOURCE_DIR}/reports/assets/report.css)
embed_asset(report_js ${CMAKE_SOURCE_DIR}/reports/assets/report.js)
foreach(part film scenery stage player sort)
  embed_asset(${part}_js ${CMAKE_SOURCE_DIR}/reports/assets/${part}.js)
endforeach()
embed_asset(chart_js ${SWARMFIT_CHART_JS})
target_link_libraries(reports PRIVATE report_assets)
