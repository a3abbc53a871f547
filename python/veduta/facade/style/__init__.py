"""Styles: what their rules derive to, compared with what a front shows."""
