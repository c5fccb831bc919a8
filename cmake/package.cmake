# The shader library as a package: `cmake --install` puts the shaders below share/crossray/shaders, where the tool looks for
# them too, and a package file beside them. A consumer needs CMake and a GLSL compiler, nothing of the harness.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/crossray) # of no processor architecture
configure_package_config_file(cmake/crossray-config.cmake.in ${CMAKE_BINARY_DIR}/crossray-config.cmake
                              INSTALL_DESTINATION ${package_dir}
                              PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/crossray-config-version.cmake
                                 COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_BINARY_DIR}/crossray-config.cmake ${CMAKE_BINARY_DIR}/crossray-config-version.cmake
        DESTINATION ${package_dir} COMPONENT shaders)
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/crossray COMPONENT shaders)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/crossray COMPONENT shaders)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/crossray COMPONENT tool)
install(TARGETS crossray COMPONENT tool)

# The man page and the completions are what the program says of itself; it is there when it is installed.
install(CODE "set(said \"${CMAKE_BINARY_DIR}/said\")" COMPONENT tool)
install(CODE [[
  function(keep_what_it_says file)
    execute_process(COMMAND "$<TARGET_FILE:crossray>" ${ARGN} OUTPUT_FILE "${said}/${file}" COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  file(MAKE_DIRECTORY "${said}")
  keep_what_it_says(crossray.1 manual)
  keep_what_it_says(crossray completion bash)
  keep_what_it_says(_crossray completion zsh)
  keep_what_it_says(crossray.fish completion fish)
  file(ARCHIVE_CREATE OUTPUT "${said}/crossray.1.gz" PATHS "${said}/crossray.1" FORMAT raw COMPRESSION GZip)
]] COMPONENT tool)
install(FILES ${CMAKE_BINARY_DIR}/said/crossray.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${CMAKE_BINARY_DIR}/said/crossray
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tool)
install(FILES ${CMAKE_BINARY_DIR}/said/_crossray
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tool)
install(FILES ${CMAKE_BINARY_DIR}/said/crossray.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tool)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT tool)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tool)

# `cpack --config build/CPackConfig.cmake` makes a .deb of it all, once crossray is built.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # the tests are not needed for it
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The crossray project <crossray@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION " Compiles a GLSL library of screen-space tracing, probes and refraction models,
 runs it on Vulkan, OpenGL and as C++, and judges what each backend answers
 against data that no GPU produced.")
# Drivers are opened while it runs: what is not there is left out, and doctor says so.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "libvulkan1, mesa-vulkan-drivers, libosmesa6, libegl1, libegl-mesa0, libgl1-mesa-dri, chromium-common")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "vulkan-validationlayers")
find_program(dpkg_shlibdeps dpkg-shlibdeps)
if(dpkg_shlibdeps)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
