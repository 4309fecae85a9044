# cmake -DWORK=<scratch folder> -P check_the_links_check.cmake: plants broken links one at a time.
cmake_minimum_required(VERSION 3.25)

# expect TEXT SUCCEEDS: of a page with TEXT beside a sound one.
function(expect text succeeds)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/there.md "# A heading, with: signs\n[back](page.md) [web](https://no.where/x)\n")
  file(WRITE ${WORK}/page.md "# Page\n${text}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/check_links.cmake
    RESULT_VARIABLE result ERROR_VARIABLE message)
  if(succeeds AND NOT result EQUAL 0)
    message(SEND_ERROR "${text}: refused: ${message}")
  elseif(NOT succeeds AND NOT message MATCHES "page.md: [^\n]*: no such")
    message(SEND_ERROR "${text}: not found: ${message}")
  endif()
endfunction()

expect("[good](there.md)" TRUE)
expect("[good](there.md#a-heading-with-signs), [own](#page) and [folder](../)" TRUE)
expect("code: `[no](link.md)`\n```\n[no](link.md)\n```" TRUE)
expect("[bad](missing.md)" FALSE)
expect("two, [good](there.md); [bad](missing.md), in one line" FALSE)
expect("[bad](there.md#no-heading)" FALSE)
expect("[bad](#nowhere)" FALSE)
expect("![picture](figures/missing.png)" FALSE)
