// Mesa's software drivers.
#pragma once

#include <string>

namespace plumbline {

/// A process can use one of the drivers, by one of the libraries (claim_process() of context.h).
enum class MesaDriver { llvmpipe, softpipe };

/// Reason, for people, why the driver rounds window positions twice: it, or the processor, lacks the fused multiply-add
/// (FMA) by which others round once. Empty: the driver rounds once.
std::string why_unfused(MesaDriver driver);

}  // namespace plumbline
