# Installs the library with its headers, the command line tool, a CMake package and a pkg-config file. Everything in the
# installed tree is relative to its own place, so that the tree can be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/derham)
install(TARGETS derham EXPORT derhamTargets FILE_SET HEADERS)
install(EXPORT derhamTargets NAMESPACE derham:: DESTINATION ${package_dir})
if(DERHAM_APPS AND TARGET derham_cli)
  install(TARGETS derham_cli)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE TYPE DOC)

# A static library hands the libraries it was built with on to whoever links it.
get_target_property(library_type derham TYPE)
set(DERHAM_STATIC OFF)
if(library_type STREQUAL "STATIC_LIBRARY")
  set(DERHAM_STATIC ON)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/FindGMP.cmake DESTINATION ${package_dir})
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/derhamConfig.cmake.in ${PROJECT_BINARY_DIR}/derhamConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/derhamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/derhamConfig.cmake ${PROJECT_BINARY_DIR}/derhamConfigVersion.cmake
        DESTINATION ${package_dir})

set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkgconfig_to_prefix /prefix/${pkgconfig_dir} /prefix)
set(pkgconfig_private "gmp pugixml zlib")
set(pkgconfig_flags "")
if(DERHAM_THREADS STREQUAL "tbb")
  string(APPEND pkgconfig_private " tbb")
elseif(DERHAM_THREADS STREQUAL "std")
  set(pkgconfig_flags " -pthread")
endif()
set(pkgconfig_requires "")
if(DERHAM_STATIC)
  set(pkgconfig_requires "${pkgconfig_private}")
  set(pkgconfig_private "")
endif()
set(pkgconfig_definitions "")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  string(APPEND pkgconfig_definitions " -fno-ipa-icf")  # as for the target, see src/derham/CMakeLists.txt
endif()
if(DERHAM_INDEX64)
  set(pkgconfig_definitions " -DDERHAM_INDEX64=1")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/derham.pc.in ${PROJECT_BINARY_DIR}/derham.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/derham.pc DESTINATION ${pkgconfig_dir})
