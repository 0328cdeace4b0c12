# `cmake --install`: the program, the runtime's headers, the CMake package, the Python package.  The
# templates travel inside the program.  The same package stands in the build folder, for find_package with
# arboc_DIR=BUILD/cmake.
include(CMakePackageConfigHelpers)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the tests are not installed

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/arboc)
install(TARGETS arboc arboc_page arboc_runtime EXPORT arbocTargets)
install(EXPORT arbocTargets NAMESPACE arboc:: DESTINATION ${package})
install(DIRECTORY runtime/arboc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" PATTERN nlp EXCLUDE)
install(DIRECTORY python/arboc DESTINATION lib/python3/dist-packages
        FILES_MATCHING PATTERN "*.py" PATTERN "*.hpp")
install(FILES README.md NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

set(folder ${PROJECT_BINARY_DIR}/cmake)
configure_package_config_file(cmake/arbocConfig.cmake.in ${folder}/arbocConfig.cmake
                              INSTALL_DESTINATION ${package})
# Before 1.0 a minor version may change anything.
write_basic_package_version_file(${folder}/arbocConfigVersion.cmake COMPATIBILITY SameMinorVersion)
foreach(file arbocAddModel.cmake arbocFiles.cmake)
  configure_file(cmake/${file} ${folder}/${file} COPYONLY)
endforeach()
install(FILES ${folder}/arbocConfig.cmake ${folder}/arbocConfigVersion.cmake
        cmake/arbocAddModel.cmake cmake/arbocFiles.cmake DESTINATION ${package})
export(EXPORT arbocTargets NAMESPACE arboc:: FILE ${folder}/arbocTargets.cmake)

# `cpack -G DEB` in the build folder.
set(CPACK_PACKAGE_NAME arboc)
set(CPACK_PACKAGE_VENDOR "the arboc authors")
set(CPACK_PACKAGE_CONTACT "the arboc authors <arboc@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compiler from robot models to specialised C++ dynamics")
set(CPACK_PACKAGE_DESCRIPTION
    "arboc reads the description of an articulated body (URDF) and writes C++ that computes the
dynamics of just that body: inverse and forward dynamics, mass matrix, kinematics, momentum, and
their derivatives.  The package has the program, its runtime headers, a CMake package with
arboc_add_model(), and a Python package.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++ | c++-compiler, cmake, libeigen3-dev, python3-numpy")
if(PROJECT_IS_TOP_LEVEL)
  include(CPack)
endif()
