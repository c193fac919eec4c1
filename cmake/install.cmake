# `cmake --install build --component library` gives another project `find_package(rink COMPONENTS im rti transport rti1516e)` with the targets rink::im, rink::rti,
# rink::transport and rink::rti1516e. Each has its own file of targets, so that whoever asks for the filters alone needs nothing but the standard library.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rink)

foreach(part im rti transport rti1516e)
  install(TARGETS rink_${part} EXPORT rink_${part}_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
  install(EXPORT rink_${part}_targets FILE rink-${part}-targets.cmake NAMESPACE rink:: DESTINATION ${package_dir} COMPONENT library)
endforeach()
foreach(folder im rti)
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rink/${folder} COMPONENT library FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY im/pairs/template/ DESTINATION ${CMAKE_INSTALL_DATADIR}/rink/plugin COMPONENT library)
configure_package_config_file(cmake/rink-config.cmake.in ${CMAKE_BINARY_DIR}/rink-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/rink-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/rink-config.cmake ${CMAKE_BINARY_DIR}/rink-config-version.cmake DESTINATION ${package_dir} COMPONENT library)
