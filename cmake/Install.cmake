# Install rules: written by the packaging step.
