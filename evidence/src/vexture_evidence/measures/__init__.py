"""What a method is worth: errors against the truth, times, bytes, and the methods that it is compared with."""
