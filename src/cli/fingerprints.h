// Fingerprints of a run: everything beside the scenes that may change a verdict. Kept verdicts and a campaign's
// journals are of one fingerprint.
#pragma once

#include <string>

#include "cli/commands.h"

namespace plumbline::cli {

/// SHA-256 of the libraries that judge and of the sources in src/cli, made by the build (src/cli/CMakeLists.txt). Left
/// out are libraries that draw for the candidate alone (src/kernels, pipeline, painter, renderers), and those of
/// src/campaign.
extern const char* const kJudgesFingerprint;

/// Fingerprint of the judges of plumb check: kJudgesFingerprint; the libraries that are loaded, by size and time; the
/// processor, for which Mesa compiles its shaders; Mesa's and Embree's settings in the environment; --against, --fault,
/// --program, --from, --each-primitive.
std::string judges_fingerprint(const CheckOptions& options);

/// Fingerprint of a campaign, for people to read, too: version and hash of this program; fault, or program with the
/// files that its command line names; --from, --each-primitive, conventions; limits; files in the folders of --assets;
/// references.
std::string campaign_fingerprint(const CheckOptions& options);

}  // namespace plumbline::cli
