# Writes the digest of all sources and headers in the directory ROOT to the C++ file OUTPUT.
file(GLOB_RECURSE FILES RELATIVE ${ROOT} ${ROOT}/source/*.cc ${ROOT}/include/*.h)
list(SORT FILES)
set(NAMES_AND_DIGESTS "")
foreach(FILE ${FILES})
  file(SHA1 ${ROOT}/${FILE} DIGEST)
  string(APPEND NAMES_AND_DIGESTS "${FILE} ${DIGEST}\n")
endforeach()
string(SHA1 DIGEST "${NAMES_AND_DIGESTS}")
file(WRITE ${OUTPUT} "#include \"rollwave/base/version.h\"

std::string rollwave::source_digest() {
  return \"${DIGEST}\";
}
")
