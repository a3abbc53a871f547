"""The verb `veduta grammar`: a rule file and building lots become buildings."""
