# rddlc_install_shell_files(<program> [COMPONENT <component>])
#
# Prints the completions and the manual page of a program whenever it is linked, and installs them where
# bash, zsh, fish and man look for them.
function(rddlc_install_shell_files program)
  cmake_parse_arguments(ARG "" "COMPONENT" "" ${ARGN})
  set(component "")
  if(ARG_COMPONENT)
    set(component COMPONENT ${ARG_COMPONENT})
  endif()
  set(folder ${PROJECT_BINARY_DIR}/shell)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(TARGET ${program} POST_BUILD
    COMMAND ${program} --completions bash > ${folder}/${program}.bash
    COMMAND ${program} --completions zsh > ${folder}/${program}.zsh
    COMMAND ${program} --completions fish > ${folder}/${program}.fish
    COMMAND ${program} --man-page > ${folder}/${program}.1)
  set(data ${CMAKE_INSTALL_DATADIR})
  install(FILES ${folder}/${program}.bash DESTINATION ${data}/bash-completion/completions
          RENAME ${program} ${component})
  install(FILES ${folder}/${program}.zsh DESTINATION ${data}/zsh/site-functions
          RENAME _${program} ${component})
  install(FILES ${folder}/${program}.fish DESTINATION ${data}/fish/vendor_completions.d ${component})
  install(FILES ${folder}/${program}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 ${component})
endfunction()
