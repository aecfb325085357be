# cpack -G DEB: plumbline and libplumbline-dev.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The plumbline team <plumbline@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_COMPONENTS_ALL plumbline development)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PLUMBLINE_PACKAGE_NAME plumbline)
set(CPACK_DEBIAN_PLUMBLINE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLUMBLINE_PACKAGE_DEPENDS libgl1-mesa-dri)  # with what shlibdeps finds
if(PLUMBLINE_OSMESA)
  string(APPEND CPACK_DEBIAN_PLUMBLINE_PACKAGE_DEPENDS ", libosmesa6")  # loaded when it is asked
endif()
set(CPACK_DEBIAN_PLUMBLINE_PACKAGE_RECOMMENDS "glmark2-data, python3-numpy")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libplumbline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libfmt-dev, libglm-dev, libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "plumbline (= ${PROJECT_VERSION}), zlib1g-dev, libxxhash-dev, libembree-dev, libegl-dev, pkg-config, libgmock-dev")
set(CPACK_COMPONENT_PLUMBLINE_DESCRIPTION "The program plumb compares what each stage of a renderer draws with independent
references, and names the stages that differ. With a suite of scenes and the Python kit.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries of the renderer and of what judges others, the kit for C and C++,
a GoogleTest matcher, and CMake files.")
include(CPack)
