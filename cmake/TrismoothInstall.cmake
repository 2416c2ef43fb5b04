# Placeholder: filled with the install rules.
