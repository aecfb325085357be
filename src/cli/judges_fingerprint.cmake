# Writes OUTPUT, a C++ file with the hash of the FILES that judge (fingerprints.h).
set(all "")
foreach(file ${FILES})
  file(SHA256 ${file} hash)
  string(APPEND all ${hash})
endforeach()
string(SHA256 print "${all}")
file(WRITE ${OUTPUT} "#include \"cli/fingerprints.h\"\nconst char* const plumbline::cli::kJudgesFingerprint = \"${print}\";\n")
