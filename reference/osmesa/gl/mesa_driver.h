// Mesa's software drivers.
#pragma once

#include <string>

namespace plumbline {

/// A process can use one of them, by one of the libraries.
enum class MesaDriver { llvmpipe, softpipe };

/// Why the driver rounds window positions twice, where OpenGL on other machines rounds them once, by a fused
/// multiply-add (FMA); empty: it rounds them once.
std::string why_unfused(MesaDriver driver);

}  // namespace plumbline
