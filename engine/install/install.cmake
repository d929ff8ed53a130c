# cmake --install: headers below include/vellus, one library per engine room and module, and the package
# "vellus" with a target for each: find_package(vellus REQUIRED), target_link_libraries(app vellus::hair).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vellus)
set(installed)
foreach(room platform ecs frame_graph gpu asset shaders scene light temporal display character hair)
    if(TARGET vellus_${room})
        set_target_properties(vellus_${room} PROPERTIES EXPORT_NAME ${room})
        target_include_directories(vellus_${room} INTERFACE $<INSTALL_INTERFACE:include/vellus>)
        list(APPEND installed vellus_${room})
    endif()
endforeach()

add_library(vellus_engine INTERFACE)
target_link_libraries(vellus_engine
    INTERFACE vellus_platform vellus_ecs vellus_frame_graph vellus_gpu vellus_asset)
set_target_properties(vellus_engine PROPERTIES EXPORT_NAME engine)

install(TARGETS ${installed} vellus_engine EXPORT vellus_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/vellus)
install(EXPORT vellus_targets NAMESPACE vellus:: FILE vellus-targets.cmake
    DESTINATION ${package_folder})
install(DIRECTORY engine modules DESTINATION include/vellus FILES_MATCHING PATTERN "*.h")
# The mathematics headers compile as C++ too.
install(DIRECTORY shaders DESTINATION include/vellus FILES_MATCHING PATTERN "*.glsl" PATTERN "*.h")

install(FILES shaders/embed_shaders.cmake DESTINATION ${package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/vellus-config.cmake.in
    ${PROJECT_BINARY_DIR}/vellus-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vellus-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vellus-config.cmake
    ${PROJECT_BINARY_DIR}/vellus-config-version.cmake DESTINATION ${package_folder})
