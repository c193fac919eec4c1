# `cmake --install build` gives another project `find_package(rink)` with the targets rink::im and rink::rti.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rink)

install(TARGETS rink_im rink_rti rink_transport EXPORT rink_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(EXPORT rink_targets FILE rink-targets.cmake NAMESPACE rink:: DESTINATION ${package_dir} COMPONENT library)
foreach(folder im rti)
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rink/${folder} COMPONENT library FILES_MATCHING PATTERN "*.h")
endforeach()
configure_package_config_file(cmake/rink-config.cmake.in ${CMAKE_BINARY_DIR}/rink-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/rink-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/rink-config.cmake ${CMAKE_BINARY_DIR}/rink-config-version.cmake DESTINATION ${package_dir} COMPONENT library)
