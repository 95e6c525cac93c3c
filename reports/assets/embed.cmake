# SPDX-License-Identifier: MIT
# Run as a script: writes OUTPUT, a C++ source that defines swarmfit::assets::NAME with the content of INPUT.
file(READ "${INPUT}" text)
set(delimiter "asset_end")
string(FIND "${text}" ")${delimiter}\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "${INPUT} contains the end mark of its own literal")
endif()
file(WRITE "${OUTPUT}" "// Generated from ${INPUT}.\n#include \"reports/write/assets.h\"\n\nnamespace swarmfit::assets {\n"
                       "const std::string_view ${NAME} = R\"${delimiter}(${text})${delimiter}\";\n}  // namespace swarmfit::assets\n")
