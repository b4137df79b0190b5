"""Writing files: pictures, always whole."""
