// Mesa's software drivers.
#pragma once

namespace plumbline {

/// A process can use one of them, by one of the libraries.
enum class MesaDriver { llvmpipe, softpipe };

}  // namespace plumbline
