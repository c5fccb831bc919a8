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
