"""What both command lines share: options, values, signals, processes and folders of our own."""
