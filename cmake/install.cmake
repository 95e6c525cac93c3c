# SPDX-License-Identifier: MIT
# cmake --install and cpack: the component program (swarmfit, its man page, completions, licence) and the component development (the
# libraries libtrack, libeval, libswarm and fit with their headers, for find_package(swarmfit)).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# ---- the program --------------------------------------------------------------------------------------------------------------
# Libraries outside the system's folders, such as those of a conda environment, are found where they were linked; those that the
# component libraries puts beside the program, before any others, and so are those that they need (an RPATH holds for these, a RUNPATH
# does not).
set_target_properties(swarmfit PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/swarmfit" INSTALL_RPATH_USE_LINK_PATH ON)
target_link_options(swarmfit PRIVATE -Wl,--disable-new-dtags)
install(TARGETS swarmfit RUNTIME_DEPENDENCY_SET swarmfit_libraries COMPONENT program)
# Only if asked for: with these the folder runs on machines that lack the packages, but for the C library, which must not be older.
install(RUNTIME_DEPENDENCY_SET swarmfit_libraries PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv)\\.so"
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/swarmfit COMPONENT libraries EXCLUDE_FROM_ALL)
# A library with folders of its own, such as MPI's, would not look into ours.
install(CODE "
  file(GLOB found \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/swarmfit/*.so*\")
  foreach(library IN LISTS found)
    file(RPATH_REMOVE FILE \"\${library}\")
  endforeach()" COMPONENT libraries EXCLUDE_FROM_ALL)
install(FILES LICENSE CITATION.cff README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# What the program says of itself is written when it is installed, so that it cannot be out of date.
function(install_output file)  # FILE ARGUMENTS...
  list(JOIN ARGN " " arguments)
  get_filename_component(folder ${file} DIRECTORY)
  install(CODE "
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${folder}\")
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"$<TARGET_FILE:swarmfit>\" ${arguments} OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${file}\"
                    COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND CMAKE_INSTALL_MANIFEST_FILES \"\${CMAKE_INSTALL_PREFIX}/${file}\")
    message(STATUS \"Installing: \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${file}\")" COMPONENT program)
endfunction()
install_output(${CMAKE_INSTALL_MANDIR}/man1/swarmfit.1 manual man)
install_output(${CMAKE_INSTALL_DATADIR}/bash-completion/completions/swarmfit completion bash)
install_output(${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions/_swarmfit completion zsh)
install_output(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/swarmfit.fish completion fish)

# ---- the libraries ------------------------------------------------------------------------------------------------------------
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/swarmfit)
install(TARGETS libtrack libeval libswarm fit model_manuals scenario_files swarmfit_flags EXPORT swarmfit
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/swarmfit COMPONENT development)
foreach(room libtrack libeval libswarm fit)
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmfit COMPONENT development FILES_MATCHING PATTERN *.h PATTERN *.def)
endforeach()
install(EXPORT swarmfit NAMESPACE swarmfit:: FILE swarmfit-targets.cmake DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/swarmfit-config.cmake.in ${CMAKE_BINARY_DIR}/generated/swarmfit-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/swarmfit-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/swarmfit-config.cmake ${CMAKE_BINARY_DIR}/generated/swarmfit-config-version.cmake
        DESTINATION ${package_folder} COMPONENT development)

# ---- packages -----------------------------------------------------------------------------------------------------------------
set(CPACK_PACKAGE_VENDOR "The swarmfit authors")
set(CPACK_PACKAGE_CONTACT "The swarmfit authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fits and ranks models of collective motion on recorded tracks")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)  # of the .deb; archives begin with their own folder
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME swarmfit)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)  # what the program links to, with the versions that this machine's libraries ask for
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS librsvg2-bin)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libswarmfit-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libfmt-dev, libmatio-dev, libhdf5-dev, libsqlite3-dev, libpugixml-dev, libminizip-dev, libproj-dev, libssl-dev, libnlopt-dev, libnlopt-cxx-dev, zlib1g-dev, pkg-config")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program swarmfit, its man page and shell completions.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries and headers of swarmfit, for find_package(swarmfit).")
include(CPack)
