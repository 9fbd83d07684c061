# What `cmake --install` puts where: libpbr as the package's component `pbr`, and the program with its schemas. The
# modules' rules are in bakers/io.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pbrbake)

install(TARGETS pbr EXPORT pbrbakeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY libpbr/include/pbr DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(EXPORT pbrbakeTargets NAMESPACE pbrbake:: DESTINATION ${package_dir})
configure_package_config_file(cmake/pbrbakeConfig.cmake.in ${PROJECT_BINARY_DIR}/pbrbakeConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0, a minor version may break what builds against it.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pbrbakeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pbrbakeConfig.cmake ${PROJECT_BINARY_DIR}/pbrbakeConfigVersion.cmake
        DESTINATION ${package_dir})

if(PBRBAKE_BUILD_BAKERS)
    install(TARGETS pbrbake RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(DIRECTORY schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/pbrbake FILES_MATCHING PATTERN "*.json")
endif()
